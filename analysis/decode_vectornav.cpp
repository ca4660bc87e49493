// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "analysis/decode_describe.h"
#include "protocols/vectornav_lines.h"

namespace navcal::analysis {
namespace {

namespace vn = protocols::vectornav;

/// Floats that are no number can be in a message with a good checksum, and have no JSON. False when there was one.
template <std::size_t N>
bool write_numbers(FieldWriter& fields, std::string_view key, const std::optional<std::array<double, N>>& values,
                   int decimals) {
  if (!values) return true;
  bool are_finite = true;
  fields.begin_list(key);
  for (const double value : *values) {
    are_finite = are_finite && std::isfinite(value);
    fields.number({}, std::isfinite(value) ? std::optional<double>(value) : std::nullopt, decimals);
  }
  fields.end_list();
  return are_finite;
}

void write_number(FieldWriter& fields, std::string_view key, const std::optional<double>& value, int decimals) {
  if (value) fields.number(key, std::isfinite(*value) ? value : std::nullopt, decimals);
}

void write(FieldWriter& fields, const vn::Reading& reading) {
  if (reading.since_startup_ns) fields.number("since_startup_ns", *reading.since_startup_ns);
  if (reading.gps_time_ns) fields.number("gps_time_ns", *reading.gps_time_ns);
  bool can_be = true;
  const auto write_triple = [&](std::string_view key, const std::optional<vn::Triple>& values, int decimals) {
    can_be = write_numbers(fields, key, values, decimals) && can_be;
  };
  write_triple("yaw_pitch_roll_deg", reading.yaw_pitch_roll_deg, 4);
  write_triple("yaw_pitch_roll_std_deg", reading.yaw_pitch_roll_std_deg, 4);
  write_numbers(fields, "quaternion", reading.quaternion, 7);
  write_triple("rate_rad_s", reading.rate_rad_s, 7);
  write_triple("specific_force_m_s2", reading.acceleration_m_s2, 5);
  write_triple("field_uT", reading.field_uT, 4);
  write_triple("raw_rate_rad_s", reading.raw_rate_rad_s, 7);
  write_triple("raw_specific_force_m_s2", reading.raw_acceleration_m_s2, 5);
  write_triple("raw_field_uT", reading.raw_field_uT, 4);
  write_triple("position", reading.position, 9);
  write_triple("velocity_ned_m_s", reading.velocity_ned_m_s, 4);
  write_number(fields, "temperature_C", reading.temperature_C, 3);
  write_number(fields, "pressure_Pa", reading.pressure_Pa, 1);
  if (reading.unknown_fields > 0) fields.number("unknown_fields", reading.unknown_fields);
  if (!can_be) write_out_of_range(fields);
}

}  // namespace

void describe_vectornav(FieldWriter& fields, const protocols::Frame& frame) {
  if (const auto reading = vn::decode_binary(frame.bytes)) return write(fields, *reading);
  if (const auto reading = vn::decode_line(frame.bytes)) return write(fields, *reading);
  if (const auto content = vn::decode_register(frame.bytes)) {
    fields.number("register", content->number);
    return fields.text("values", content->values);
  }
  if (const auto error = vn::decode_error(frame.bytes)) {
    fields.number("error", *error);
    fields.text("meaning", vn::meaning_of(*error));
  }
}

}  // namespace navcal::analysis
