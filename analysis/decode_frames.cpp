// SPDX-License-Identifier: Apache-2.0
#include "analysis/decode_frames.h"

#include <utility>

#include "analysis/decode_stream.h"
#include "protocols/device_types.h"
#include "protocols/parsers.h"

namespace navcal::analysis {
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
    {Protocol::described, nullptr},  // by a description of its own: decode_described.h
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
