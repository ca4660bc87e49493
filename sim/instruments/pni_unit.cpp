// SPDX-License-Identifier: Apache-2.0
#include "sim/instruments/pni_unit.h"

#include <algorithm>
#include <cmath>

#include "base/angles.h"
#include "protocols/wire_fields.h"
#include "sim/rotation.h"

namespace navcal::sim {
namespace {

namespace trax = protocols::trax;
using trax::Component;
using trax::FrameNumber;

constexpr std::int64_t kPniLatency_ns = 30'000'000;
/// The automatic sampling looks this often, and takes a sample when the device has turned so far since the last.
constexpr std::int64_t kLook_ns = 100'000'000;
constexpr double kSampleTurn_rad = 25 * base::kRadiansPerDegree;

}  // namespace

void PniUnit::power_on(std::int64_t t_ns) {
  forget();
  electronics_.power_on(t_ns, motion_);
  components_ = {static_cast<std::uint8_t>(Component::heading), static_cast<std::uint8_t>(Component::pitch),
                 static_cast<std::uint8_t>(Component::roll)};
  continuous_ = calibrating_ = false;
  polled_ = automatic_ = true;
  interval_s_ = 0.1;
  points_ = 12;
}

std::int64_t PniUnit::next_act_ns() const {
  return std::min(continuous_ ? ticks_.next_ns() : kNever_ns,
                  calibrating_ && automatic_ ? next_look_ns_ : kNever_ns);
}

void PniUnit::act(std::int64_t now_ns, std::vector<Emission>& out) {
  if (continuous_ && ticks_.next_ns() == now_ns) {
    ticks_.pass();
    if (line_.free_ns() <= now_ns) send(now_ns, data(now_ns), out);
    return;
  }
  next_look_ns_ += kLook_ns;
  const double yaw_rad = motion_.at(now_ns).euler_rad[2];
  if (samples_.empty() || std::abs(base::wrapped(yaw_rad - samples_.back().heading_rad)) > kSampleTurn_rad)
    take_calibration_sample(now_ns);
}

void PniUnit::obey(std::int64_t t_ns, const protocols::Frame& command) {
  const protocols::Bytes frame = command.bytes;
  const protocols::Bytes payload = frame.subspan(3, frame.size() - trax::kOverhead);
  switch (static_cast<FrameNumber>(frame[2])) {
    case FrameNumber::get_module_info: {
      constexpr std::uint8_t kTypeAndRevision[] = {'T', 'R', 'A', 'X', '0', '4', '0', '0'};
      return say(t_ns, trax::encode_frame(FrameNumber::module_info, kTypeAndRevision));
    }
    case FrameNumber::set_data_components:
      if (!payload.empty() && payload.size() == 1U + payload[0])
        components_.assign(payload.begin() + 1, payload.end());
      return;
    case FrameNumber::get_data:
      return answer(t_ns + kThinks_ns + kPniLatency_ns, [this](std::int64_t due_ns) { return data(due_ns); });
    case FrameNumber::set_config: return obey_setting(t_ns, payload);
    case FrameNumber::set_acquisition:
      if (const auto acquisition = trax::decode_acquisition(frame)) {
        polled_ = acquisition->polled;
        interval_s_ = std::clamp(acquisition->interval_s, 0.02, 100.0);
        say(t_ns, trax::encode_frame(FrameNumber::acquisition_done));
      }
      return;
    case FrameNumber::start_continuous:
      continuous_ = options_.has_continuous && !polled_ && !calibrating_;
      if (continuous_) ticks_ = Ticks(t_ns, interval_s_, options_.clock_ppm);
      return;
    case FrameNumber::stop_continuous: continuous_ = false; return;
    case FrameNumber::save: {
      constexpr std::uint8_t kNoError[] = {0, 0};
      return say(t_ns, trax::encode_frame(FrameNumber::save_done, kNoError));
    }
    case FrameNumber::start_calibration: return start_calibration(t_ns);
    case FrameNumber::stop_calibration: calibrating_ = false; return;
    case FrameNumber::take_calibration_sample:
      if (calibrating_) take_calibration_sample(t_ns);
      return;
    default: return;
  }
}

void PniUnit::obey_setting(std::int64_t t_ns, protocols::Bytes payload) {
  if (payload.size() < 2) return;
  const auto setting = static_cast<trax::Setting>(payload[0]);
  if (setting == trax::Setting::calibration_points && payload.size() >= 5) {
    points_ = std::clamp(protocols::get_be<std::uint32_t>(&payload[1]), std::uint32_t{4}, std::uint32_t{32});
  } else if (setting == trax::Setting::automatic_sampling) {
    automatic_ = payload[1] != 0;
  }
  say(t_ns, trax::encode_frame(FrameNumber::set_config_done));
}

void PniUnit::start_calibration(std::int64_t t_ns) {
  calibrating_ = true;
  continuous_ = false;
  samples_.clear();
  next_look_ns_ = t_ns + kLook_ns;
  say(t_ns, trax::encode_sample_count(0));
}

/// The score follows the last sample: scatter of headings and tilts, as far as a host can see it.
void PniUnit::take_calibration_sample(std::int64_t t_ns) {
  const State state = motion_.at(t_ns);
  samples_.push_back({base::wrapped(state.euler_rad[2]), state.euler_rad[1], state.euler_rad[0]});
  say(t_ns, trax::encode_sample_count(static_cast<std::uint32_t>(samples_.size())));
  if (samples_.size() < points_) return;
  calibrating_ = false;
  double north = 0, east = 0, least_rad = 0, greatest_rad = 0;
  for (const Sample& sample : samples_) {
    north += std::cos(sample.heading_rad) / static_cast<double>(samples_.size());
    east += std::sin(sample.heading_rad) / static_cast<double>(samples_.size());
    least_rad = std::min({least_rad, sample.pitch_rad, sample.roll_rad});
    greatest_rad = std::max({greatest_rad, sample.pitch_rad, sample.roll_rad});
  }
  const double uneven = std::hypot(north, east);
  const double tilt_range_deg = (greatest_rad - least_rad) * base::kDegreesPerRadian;
  say(t_ns, trax::encode_score({.magnetometer = 0.25 + uneven,
                                .reserved = 0,
                                .accelerometer = 0.5,
                                .distribution_error = uneven,
                                .tilt_error = tilt_range_deg < 10 ? 1.0 : 0.0,
                                .tilt_range_deg = tilt_range_deg}));
}

std::vector<std::uint8_t> PniUnit::data(std::int64_t t_ns) {
  const std::int64_t measured_ns = t_ns - kPniLatency_ns;
  const State state = motion_.at(measured_ns);
  const Vector3 field =
      noisy(transpose(R_world_from_body(state.euler_rad)) * state.field_world_uT, options_.compass.field_noise_uT);
  const double roll_rad = state.euler_rad[0] + noise_.normal(options_.compass.tilt_noise_rad);
  const double pitch_rad = state.euler_rad[1] + noise_.normal(options_.compass.tilt_noise_rad);
  // The field in level axes, which yaw with the vehicle.
  const Vector3 level = R_world_from_body({roll_rad, pitch_rad, 0}) * field;
  const auto asked = [&](Component component) {
    return std::ranges::find(components_, static_cast<std::uint8_t>(component)) != components_.end();
  };
  trax::Data data;
  if (asked(Component::heading))
    data.heading_deg = base::as_heading(std::atan2(-level[1], level[0])) * base::kDegreesPerRadian;
  if (asked(Component::pitch)) data.pitch_deg = pitch_rad * base::kDegreesPerRadian;
  if (asked(Component::roll)) data.roll_deg = roll_rad * base::kDegreesPerRadian;
  if (asked(Component::temperature)) data.temperature_C = electronics_.temperature_C(measured_ns, motion_);
  if (asked(Component::distortion)) data.distorted = false;
  if (asked(Component::heading_status)) data.heading_status = 0;
  constexpr Component kField[] = {Component::field_x, Component::field_y, Component::field_z};
  constexpr Component kForce[] = {Component::acceleration_x, Component::acceleration_y, Component::acceleration_z};
  for (std::size_t i = 0; i < 3; ++i) {
    if (asked(kField[i])) data.field_uT[i] = field[i];
    if (asked(kForce[i]))  // gravity, positive down
      data.acceleration_m_s2[i] = -state.specific_force_m_s2[i] + noise_.normal(options_.force_noise_m_s2);
  }
  return trax::encode_data(data);
}

}  // namespace navcal::sim
