// SPDX-License-Identifier: Apache-2.0

#include "analysis/decode_describe.h"
#include "protocols/ubx_configuration.h"
#include "protocols/ubx_navigation.h"
#include "protocols/ubx_receiver.h"

namespace navcal::analysis {
namespace {

namespace ubx = protocols::ubx;
using protocols::Date;

/// Date and time with the correction of the second, which may be negative.
void put_corrected_time(const ubx::NavPvt& pvt, PositionFields& position) {
  const auto utc_ns = pvt.utc_ns();
  if (!utc_ns) return;
  if (pvt.nanosecond >= 0 && pvt.nanosecond < 1'000'000'000) {
    position.date = pvt.date;
    position.time =
        protocols::TimeOfDay{pvt.hour, pvt.minute, pvt.second, static_cast<std::uint32_t>(pvt.nanosecond)};
    return;
  }
  position.date = protocols::date_of(*utc_ns);
  position.time = protocols::time_of_day(*utc_ns);
}

void write(FieldWriter& fields, const ubx::NavPvt& pvt) {
  PositionFields position;
  put_corrected_time(pvt, position);
  position.fix = pvt.fix();
  position.tracked = pvt.satellites;
  const bool can_be = std::abs(pvt.latitude_deg) <= 90 && std::abs(pvt.longitude_deg) <= 180 &&
                      (position.time || !pvt.date_valid || !pvt.time_valid);
  if (can_be && position.fix != protocols::Fix::none) {
    position.lat = pvt.latitude_deg;
    position.lon = pvt.longitude_deg;
    position.height_m = pvt.height_m;
    position.height_msl_m = pvt.height_msl_m;
    position.speed_m_s = pvt.ground_speed_m_s;
    position.heading_deg = pvt.heading_of_motion_deg;
    position.dop = pvt.pdop;
  }
  write_position(fields, position);
  fields.number("time_of_week_ms", pvt.time_of_week_ms);
  fields.flag("fully_resolved", pvt.fully_resolved);
  fields.number("time_accuracy_s", pvt.time_accuracy_s, 9);
  fields.number("horizontal_accuracy_m", pvt.horizontal_accuracy_m, 3);
  fields.number("vertical_accuracy_m", pvt.vertical_accuracy_m, 3);
  fields.numbers("velocity_ned_m_s", pvt.velocity_ned_m_s, 3);
  fields.number("speed_accuracy_m_s", pvt.speed_accuracy_m_s, 3);
  fields.number("heading_accuracy_deg", pvt.heading_accuracy_deg, 5);
  fields.flag("differential", pvt.differential);
  fields.number("carrier_solution", pvt.carrier_solution);
  if (!can_be) write_out_of_range(fields);
}

void write(FieldWriter& fields, const ubx::NavTimeGps& time) {
  fields.number("time_of_week_ms", time.time_of_week_ms);
  fields.number("fraction_ns", time.fraction_ns);
  fields.number("week", time.week);
  fields.number("utc_offset_s", time.leap_valid ? std::optional<int>(time.leap_s) : std::nullopt);
  fields.flag("leap_known", time.leap_valid);
  fields.flag("time_valid", time.time_of_week_valid && time.week_valid);
  fields.number("time_accuracy_s", time.time_accuracy_s, 9);
}

void write(FieldWriter& fields, const ubx::NavDop& dop) {
  fields.number("time_of_week_ms", dop.time_of_week_ms);
  fields.number("gdop", dop.geometric, 2);
  fields.number("pdop", dop.position, 2);
  fields.number("tdop", dop.time, 2);
  fields.number("vdop", dop.vertical, 2);
  fields.number("hdop", dop.horizontal, 2);
  fields.number("ndop", dop.northing, 2);
  fields.number("edop", dop.easting, 2);
}

void write(FieldWriter& fields, const ubx::NavSat& sat) {
  fields.number("time_of_week_ms", sat.time_of_week_ms);
  fields.number("visible", sat.count);
  fields.objects("satellites", std::span(sat.satellites).first(sat.count), [&](const auto& satellite) {
    const bool placed = std::abs(satellite.elevation_deg) <= 90;
    fields.number("gnss", satellite.gnss);
    fields.number("satellite", satellite.number);
    fields.number("elevation_deg", placed ? std::optional<int>(satellite.elevation_deg) : std::nullopt);
    fields.number("azimuth_deg", placed ? std::optional<int>(satellite.azimuth_deg) : std::nullopt);
    fields.number("cn0_dBHz", satellite.cn0_dBHz);
    fields.number("residual_m", satellite.residual_m, 1);
    fields.number("quality", satellite.quality);
    fields.flag("used", satellite.used);
    fields.number("health", satellite.health);
  });
}

void write(FieldWriter& fields, const ubx::Version& version) {
  fields.text("software", version.software);
  fields.text("hardware", version.hardware);
  fields.begin_list("extensions");
  for (const std::string& extension : version.extensions) fields.text({}, extension);
  fields.end_list();
}

void write(FieldWriter& fields, const ubx::TimePulse& pulse) {
  fields.number("time_of_week_ms", pulse.time_of_week_ms);
  fields.number("fraction_ms", pulse.fraction_ms, 9);
  fields.number("week", pulse.week);
  fields.text("pulse_of", pulse.is_utc ? "utc" : "gnss");
  fields.number("quantization_ps",
                pulse.quantization_valid ? std::optional<int>(pulse.quantization_ps) : std::nullopt);
}

void write(FieldWriter& fields, const ubx::Acknowledgement& answer) {
  fields.text("answers", ubx::id_of(answer.code).view());
  fields.flag("accepted", answer.accepted);
}

/// Decoded, or said to be out of range where the payload is too short.
template <class Message>
void write_decoded(FieldWriter& fields, const std::optional<Message>& message) {
  if (message) return write(fields, *message);
  write_out_of_range(fields);
}

}  // namespace

void describe_ubx(FieldWriter& fields, const protocols::Frame& frame) {
  switch (ubx::code_of(frame).value_or(0)) {
    case ubx::kNavPvt: return write_decoded(fields, ubx::decode_nav_pvt(frame.bytes));
    case ubx::kNavTimeGps: return write_decoded(fields, ubx::decode_nav_timegps(frame.bytes));
    case ubx::kNavDop: return write_decoded(fields, ubx::decode_nav_dop(frame.bytes));
    case ubx::kNavSat: return write_decoded(fields, ubx::decode_nav_sat(frame.bytes));
    case ubx::kMonVer:
      // Without a payload it is the question.
      if (frame.bytes.size() == ubx::kOverhead) return;
      return write_decoded(fields, ubx::decode_mon_ver(frame.bytes));
    case ubx::kTimTp: return write_decoded(fields, ubx::decode_tim_tp(frame.bytes));
    case ubx::kAckAck:
    case ubx::kAckNak: return write_decoded(fields, ubx::decode_acknowledgement(frame.bytes));
    default: return;
  }
}

}  // namespace navcal::analysis
