// SPDX-License-Identifier: Apache-2.0
// Frames of Doppler logs.
#include <fmt/format.h>

#include "analysis/decode_describe.h"
#include "protocols/pd0.h"
#include "protocols/pd6.h"
#include "protocols/water_linked.h"

namespace navcal::analysis {
namespace {

using protocols::Frame;
namespace pd0 = protocols::pd0;
namespace pd6 = protocols::pd6;
namespace water_linked = protocols::water_linked;

constexpr std::string_view kAxesNames[] = {"beam", "instrument", "ship", "earth"};

void write(FieldWriter& fields, const pd0::FixedLeader& fixed) {
  fields.text("axes", kAxesNames[static_cast<std::size_t>(fixed.axes)]);
  fields.flag("uses_tilts", fixed.uses_tilts);
  fields.flag("looks_up", fixed.looks_up());
  fields.number("beam_angle_deg", fixed.beam_angle_deg(), 0);
  fields.number("heading_alignment_deg", fixed.heading_alignment_deg, 2);
  fields.number("used_sensors", fixed.used_sensors & fixed.fitted_sensors);
}

void write(FieldWriter& fields, const pd0::VariableLeader& variable) {
  fields.number("ensemble", variable.ensemble);
  // The instrument's clock has no time zone.
  fields.text("clock",
              fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}.{:02}", variable.date.year, variable.date.month,
                          variable.date.day, variable.time.hour, variable.time.minute, variable.time.second,
                          variable.time.nanosecond / 10'000'000));
  fields.number("heading_deg", variable.heading_deg, 2);
  fields.number("pitch_deg", variable.pitch_deg, 2);
  fields.number("roll_deg", variable.roll_deg, 2);
  fields.number("temperature_C", variable.temperature_C, 2);
  fields.number("salinity_ppt", variable.salinity_ppt, 0);
  fields.number("sound_speed_m_s", variable.speed_of_sound_m_s, 0);
  fields.number("depth_m", variable.depth_m, 1);
  fields.number("pressure_Pa", variable.pressure_Pa, 0);
  fields.number("self_test", variable.self_test);
}

void write(FieldWriter& fields, const pd0::BottomTrack& bottom) {
  fields.numbers("range_m", bottom.range_m, 2);
  fields.numbers("bottom_velocity_m_s", bottom.velocity_m_s, 3);
  fields.numbers("percent_good", bottom.percent_good);
  fields.numbers("water_velocity_m_s", bottom.water_velocity_m_s, 3);
  fields.numbers("water_percent_good", bottom.water_percent_good);
}

void write(FieldWriter& fields, const pd6::Timing& timing) {
  fields.text("clock", {timing.clock.data(), timing.clock.size()});
  fields.number("salinity_ppt", timing.salinity_ppt, 1);
  fields.number("temperature_C", timing.temperature_C, 1);
  fields.number("depth_m", timing.depth_m, 1);
  fields.number("sound_speed_m_s", timing.speed_of_sound_m_s, 1);
  fields.number("self_test", timing.self_test);
}

void write(FieldWriter& fields, const pd6::Attitude& attitude) {
  fields.number("heading_deg", attitude.heading_deg, 2);
  fields.number("pitch_deg", attitude.pitch_deg, 2);
  fields.number("roll_deg", attitude.roll_deg, 2);
}

void write(FieldWriter& fields, const pd6::Distance& distance) {
  fields.numbers("east_north_up_m", distance.east_north_up_m, 2);
  fields.number("range_m", distance.range_m, 2);
  fields.number("since_good_s", distance.since_good_s, 2);
}

void write(FieldWriter& fields, const pd6::Velocity& velocity) {
  fields.numbers("velocity_m_s", velocity.velocity_m_s, 3);
  fields.number("error_velocity_m_s", velocity.error_velocity_m_s, 3);
  fields.flag("good", velocity.good);
}

void write(FieldWriter& fields, const water_linked::Velocity& velocity) {
  fields.numbers("velocity_m_s", velocity.velocity_m_s, 3);
  fields.flag("valid", velocity.valid);
  fields.number("altitude_m", velocity.altitude_m, 2);
  fields.number("figure_of_merit_m_s", velocity.figure_of_merit_m_s, 3);
  fields.numbers("covariance_m2_s2", velocity.covariance_m2_s2);
  fields.number("valid_at_us", velocity.valid_at_us);
  fields.number("transmitted_at_us", velocity.transmitted_at_us);
  fields.number("since_last_ms", velocity.since_last_ms, 2);
  fields.number("status", velocity.status);
}

void write(FieldWriter& fields, const water_linked::Transducer& transducer) {
  fields.number("beam", transducer.number);
  fields.number("velocity_m_s", transducer.velocity_m_s, 3);
  fields.number("range_m", transducer.distance_m, 2);
  fields.number("signal_dBm", transducer.signal_dBm, 0);
  fields.number("noise_dBm", transducer.noise_dBm, 0);
}

void write(FieldWriter& fields, const water_linked::Position& position) {
  fields.number("clock_s", position.time_s, 3);
  fields.numbers("position_m", position.position_m, 2);
  fields.number("position_std_m", position.std_m, 2);
  fields.number("roll_deg", position.roll_deg, 1);
  fields.number("pitch_deg", position.pitch_deg, 1);
  fields.number("yaw_deg", position.yaw_deg, 1);
  fields.number("status", position.status);
}

template <class Decoded>
void write_if_decoded(FieldWriter& fields, const Decoded& decoded) {
  if (decoded) return write(fields, *decoded);
  write_out_of_range(fields);
}

}  // namespace

void describe_pd0(FieldWriter& fields, const Frame& frame) {
  const pd0::Ensemble ensemble = pd0::decode(frame.bytes);
  if (ensemble.variable) write(fields, *ensemble.variable);
  if (ensemble.fixed) write(fields, *ensemble.fixed);
  if (ensemble.bottom) write(fields, *ensemble.bottom);
  fields.number("other_types", ensemble.unknown_types);
  if (ensemble.invalid_types > 0) write_out_of_range(fields);
}

void describe_pd6(FieldWriter& fields, const Frame& frame) {
  if (frame.id == pd6::kAttitude) {
    write_if_decoded(fields, pd6::decode_attitude(frame.bytes));
  } else if (frame.id == pd6::kTiming) {
    write_if_decoded(fields, pd6::decode_timing(frame.bytes));
  } else if (frame.id == pd6::kBottomDistance || frame.id == pd6::kWaterDistance) {
    write_if_decoded(fields, pd6::decode_distance(frame.bytes));
  } else {
    write_if_decoded(fields, pd6::decode_velocity(frame.bytes));
  }
}

void describe_water_linked(FieldWriter& fields, const Frame& frame) {
  if (frame.id == water_linked::kVelocity || frame.id == water_linked::kVelocityOld ||
      frame.id == water_linked::kVelocityJson) {
    write_if_decoded(fields, water_linked::decode_velocity(frame.bytes));
  } else if (frame.id == water_linked::kTransducer) {
    write_if_decoded(fields, water_linked::decode_transducer(frame.bytes));
  } else if (frame.id == water_linked::kPosition || frame.id == water_linked::kPositionJson) {
    write_if_decoded(fields, water_linked::decode_position(frame.bytes));
  }
}

}  // namespace navcal::analysis
