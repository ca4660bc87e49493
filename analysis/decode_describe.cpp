// SPDX-License-Identifier: Apache-2.0
#include "analysis/decode_describe.h"

#include <utility>

#include "analysis/decode_stream.h"
#include "protocols/device_types.h"
#include "protocols/parsers.h"

namespace navcal::analysis {

void write_time(FieldWriter& fields, const std::optional<protocols::Date>& date,
                const std::optional<protocols::TimeOfDay>& time) {
  if (date && time) {
    const auto& pivot = fields.pivot();
    const auto moved = pivot ? protocols::correct_rollover(*date, *pivot) : protocols::CorrectedDate{*date, false};
    fields.time("time", moved.date, *time);
    fields.flag("time_corrected", moved.corrected);
  } else {
    fields.null("time");
    fields.flag("time_corrected", false);
  }
}

void write_position(FieldWriter& fields, const PositionFields& position) {
  write_time(fields, position.date, position.time);
  fields.number("lat", position.lat, 9);
  fields.number("lon", position.lon, 9);
  fields.number("height_m", position.height_m, 3);
  fields.number("height_msl_m", position.height_msl_m, 3);
  fields.number("speed_m_s", position.speed_m_s, 4);
  fields.number("heading_deg", position.heading_deg, 3);
  fields.number("dop", position.dop, 2);
  fields.number("visible", position.visible);
  fields.number("tracked", position.tracked);
  if (!position.fix) return fields.null("fix");
  fields.text("fix", name_of(*position.fix));
}

void write_out_of_range(FieldWriter& fields) { fields.flag("out_of_range", true); }

namespace {

using protocols::Protocol;

constexpr protocols::PerDevice<Describe> kDescriptions({
    {Protocol::tcm2, describe_tcm2},
    {Protocol::imu_card, describe_imu_card},
    {Protocol::oncore, describe_oncore},
    {Protocol::motor_card, describe_motor_card},
    {Protocol::nmea, describe_nmea},
    {Protocol::ubx, describe_ubx},
    {Protocol::mip, describe_mip},
    {Protocol::vectornav, describe_vectornav},
    {Protocol::pni, describe_pni},
    {Protocol::pd0, describe_pd0},
    {Protocol::pd6, describe_pd6},
    {Protocol::water_linked, describe_water_linked},
    {Protocol::samples, describe_samples},
    {Protocol::paroscientific, describe_paroscientific},
    {Protocol::keller, describe_keller},
    {Protocol::described, nullptr},  // by a description of its own
    {Protocol::mavlink, describe_mavlink},
});

using NextBytes = std::function<protocols::Bytes()>;
using OnFrame = std::function<void(const protocols::Frame&)>;
using DecodeFunction = DecodeSummary (*)(const NextBytes&, const OnFrame&);

template <std::size_t Row>
DecodeSummary decode_row(const NextBytes& next, const OnFrame& on_frame) {
  return decode_stream<typename protocols::ScannersOf<protocols::kDeviceTypes[Row].protocol>::Own>(next, on_frame);
}

template <std::size_t... Row>
DecodeFunction decode_function(Protocol protocol, std::index_sequence<Row...>) {
  constexpr std::array<DecodeFunction, sizeof...(Row)> kFunctions{&decode_row<Row>...};
  return kFunctions.at(static_cast<std::size_t>(protocol));
}

}  // namespace

DecodeSummary decode_frames(Protocol protocol, const NextBytes& next, const OnFrame& on_frame) {
  return decode_function(protocol, std::make_index_sequence<protocols::kDeviceCount>{})(next, on_frame);
}

Describe description_of(Protocol protocol) { return kDescriptions[protocol]; }

}  // namespace navcal::analysis
