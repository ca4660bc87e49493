// SPDX-License-Identifier: Apache-2.0
#include "analysis/decode_describe.h"
#include "base/angles.h"
#include "protocols/mip.h"

namespace navcal::analysis {
namespace {

namespace mip = protocols::mip;

void write_triple(FieldWriter& fields, std::string_view key, const std::optional<mip::Triple>& triple,
                  double scale, int decimals) {
  if (!triple) return;
  fields.begin_list(key);
  for (const double one : *triple) fields.number({}, one * scale, decimals);
  fields.end_list();
}

void write_clocks(FieldWriter& fields, const mip::Packet& packet) {
  if (packet.reference_time_ns)
    fields.number("reference_time_s", 1e-9 * static_cast<double>(*packet.reference_time_ns), 9);
  if (packet.gps_time) {
    fields.number("gps_week", packet.gps_time->week);
    fields.number("gps_time_of_week_s", packet.gps_time->time_of_week_s, 6);
    fields.flag("gps_time_valid", packet.gps_time->time_of_week_valid && packet.gps_time->week_valid);
  }
}

void write_sensor(FieldWriter& fields, const mip::Packet& packet) {
  write_triple(fields, "specific_force_m_s2", packet.acceleration_m_s2, 1, 5);
  write_triple(fields, "rate_rad_s", packet.rate_rad_s, 1, 6);
  write_triple(fields, "field_uT", packet.field_uT, 1, 3);
  write_triple(fields, "delta_theta_rad", packet.delta_theta_rad, 1, 8);
  write_triple(fields, "delta_velocity_m_s", packet.delta_velocity_m_s, 1, 6);
  write_triple(fields, "euler_deg", packet.euler_rad, base::kDegreesPerRadian, 3);
  if (packet.pressure_Pa) fields.number("pressure_Pa", *packet.pressure_Pa, 1);
}

void write_filter(FieldWriter& fields, const mip::Packet& packet) {
  if (packet.filter_position) {
    fields.number("lat", (*packet.filter_position)[0], 9);
    fields.number("lon", (*packet.filter_position)[1], 9);
    fields.number("height_m", (*packet.filter_position)[2], 3);
  }
  write_triple(fields, "velocity_ned_m_s", packet.filter_velocity_ned_m_s, 1, 4);
  write_triple(fields, "euler_deg", packet.filter_euler_rad, base::kDegreesPerRadian, 3);
  write_triple(fields, "euler_std_deg", packet.filter_euler_std_rad, base::kDegreesPerRadian, 3);
  write_triple(fields, "gyro_bias_rad_s", packet.filter_gyro_bias_rad_s, 1, 7);
  write_triple(fields, "rate_rad_s", packet.filter_rate_rad_s, 1, 6);
  if (packet.filter_state) fields.number("state", *packet.filter_state);
}

}  // namespace

void describe_mip(FieldWriter& fields, const protocols::Frame& frame) {
  const mip::Packet packet = mip::decode(frame.bytes);
  if (packet.reply) {
    fields.number("command", packet.reply->command);
    fields.number("error", packet.reply->error);
  }
  if (packet.base_rate) fields.number("base_rate_Hz", packet.base_rate->rate_Hz);
  write_clocks(fields, packet);
  write_sensor(fields, packet);
  write_filter(fields, packet);
  if (packet.unknown_fields > 0) fields.number("unknown_fields", packet.unknown_fields);
  if (packet.invalid_fields > 0) fields.number("invalid_fields", packet.invalid_fields);
}

}  // namespace navcal::analysis
