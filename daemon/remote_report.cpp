// SPDX-License-Identifier: Apache-2.0
#include "daemon/remote_report.h"

#include "base/angles.h"

namespace navcal::daemon {
namespace {

/// A report of all calibrators costs more than everything else here.
constexpr std::int64_t kCalibrators_ns = 5'000'000'000;

std::optional<double> degrees(const std::optional<double>& angle_rad) {
  if (!angle_rad) return std::nullopt;
  return *angle_rad * base::kDegreesPerRadian;
}

std::vector<link::CalibrationState> calibrators_of(const calib::Report& report) {
  std::vector<link::CalibrationState> states;
  for (const auto& one : report.calibrators) {
    link::CalibrationState state;
    state.calibrator = calib::name_of(one.calibrator);
    state.verdict = static_cast<std::uint8_t>(one.verdict);
    state.number = static_cast<std::uint16_t>(report.name.number);
    state.hash = static_cast<std::uint32_t>(report.name.sum);
    states.push_back(std::move(state));
  }
  return states;
}

}  // namespace

link::Report RemoteReport::of(const VehicleState& state, const pipeline::Pipeline& pipeline, std::int64_t now_ns) {
  link::Report report;
  if (state.time_utc_ns) report.time_utc_ms = *state.time_utc_ns / 1'000'000;
  report.is_north_true = state.is_north_true;
  report.heading_deg = degrees(state.heading_rad);
  report.pitch_deg = degrees(state.pitch_rad);
  report.roll_deg = degrees(state.roll_rad);
  if (state.rate_rad_s) {
    for (std::size_t i = 0; i < report.rate_deg_s.size(); ++i)
      report.rate_deg_s.at(i) = degrees(state.rate_rad_s->at(i));
  }
  report.depth_m = state.depth_m;
  report.latitude_deg = degrees(state.latitude_rad);
  report.longitude_deg = degrees(state.longitude_rad);
  report.position_std_m = state.position_std_m;
  report.heading_std_deg = degrees(state.heading_std_rad);
  report.depth_std_m = state.depth_std_m;
  report.speed_m_s = state.speed_m_s;
  report.climb_m_s = state.climb_m_s;
  report.shaft_rpm = state.shaft_rpm;
  report.fins_deg = state.fins_deg;
  report.compass_age_s = state.compass_age_s;
  report.imu_age_s = state.imu_age_s;
  report.gps_age_s = state.gps_age_s;
  report.motor_age_s = state.motor_age_s;
  for (const std::string_view alarm : state.alarms) report.set_alarm(alarm);
  if (const auto battery = pipeline.battery()) {
    report.battery_V = battery->voltage_V;
    if (battery->charge && battery->capacity_Ah > 0)
      report.battery_charge = battery->charge->charge_Ah / battery->capacity_Ah;
  }
  report.order_sequence = static_cast<std::uint16_t>(state.order_sequence);
  report.holder = state.holder;
  if (!state.holder.empty()) {
    report.priority = static_cast<std::uint16_t>(state.priority);
    report.expires_in_s = state.expires_in_s;
  }
  if (now_ns >= calibrators_due_ns_) {
    calibrators_due_ns_ = now_ns + kCalibrators_ns;
    calibrators_ = calibrators_of(pipeline.calibration_report());
  }
  if (!calibrators_.empty()) report.calibration = calibrators_[next_++ % calibrators_.size()];
  return report;
}

}  // namespace navcal::daemon
