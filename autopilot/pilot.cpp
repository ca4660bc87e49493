// SPDX-License-Identifier: Apache-2.0
#include "autopilot/pilot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "autopilot/manoeuvre.h"
#include "autopilot/shaft_speed.h"

namespace navcal::autopilot {
namespace {

/// Readings further apart than this count as if they were not, so that no integral leaps.
constexpr double kLongestPeriod_s = 0.5;

bool is_silent(const std::optional<double>& age_s, double limit_s) { return !age_s || *age_s > limit_s; }

std::string silence(std::string_view device, const std::optional<double>& age_s) {
  if (!age_s) return fmt::format("{}: silent", device);
  return fmt::format("{}: silent for {:.1f} s", device, *age_s);
}

}  // namespace

Pilot::Pilot(const config::VehicleSettings& vehicle, const config::Mission& mission, const PilotLimits& limits)
    : vehicle_(vehicle), limits_(limits), mission_(vehicle, mission), to_surface_(vehicle) {}

std::vector<std::string> Pilot::missing(const Reading& reading) const {
  std::vector<std::string> reasons;
  const auto want = [&](bool there, std::string_view reason) {
    if (!there) reasons.emplace_back(reason);
  };
  want(!is_silent(reading.compass_age_s, limits_.age_s), "no compass: its port is silent");
  want(!is_silent(reading.imu_age_s, limits_.age_s), "no inertial card: its port is silent");
  want(!is_silent(reading.motor_age_s, limits_.age_s), "no motor card: its port is silent");
  want(reading.heading_rad.has_value(), "no heading");
  want(reading.pitch_rad.has_value(), "no pitch");
  want(reading.rate_rad_s.has_value(), "no turn rates");
  want(reading.depth_m.has_value(), "no depth");
  if (const auto reason = alarm(reading, 0); reason && reasons.empty()) reasons.push_back(*reason);
  return reasons;
}

std::optional<std::string> Pilot::alarm(const Reading& reading, double now_s) const {
  for (const std::string& alarm : reading.alarms) {
    if (alarm.find("leak") != std::string::npos) return alarm;
    if (alarm.find("supply") != std::string::npos) return alarm;
    if (alarm == "battery low" || alarm == "floor near") return alarm;
  }
  if (is_silent(reading.compass_age_s, limits_.age_s)) return silence("compass", reading.compass_age_s);
  if (is_silent(reading.imu_age_s, limits_.age_s)) return silence("inertial card", reading.imu_age_s);
  if (is_silent(reading.motor_age_s, limits_.age_s)) return silence("motor card", reading.motor_age_s);
  if (!reading.heading_rad || !reading.pitch_rad) return "compass: no heading or no pitch";
  if (!reading.rate_rad_s || !reading.depth_m) return "inertial card: no turn rates or no depth";
  if (*reading.depth_m > limits_.depth_m)
    return fmt::format("depth {:.2f} m, more than {:g} m", *reading.depth_m, limits_.depth_m);
  if (reading.altitude_m && *reading.altitude_m < limits_.altitude_m)
    return fmt::format("{:.2f} m above the floor, less than {:g} m", *reading.altitude_m, limits_.altitude_m);
  if (elapsed_s(now_s) > limits_.duration_s)
    return fmt::format("{:.1f} minutes are over", limits_.duration_s / 60);
  const double range_m = std::hypot(offset_m_[0], offset_m_[1]);
  if (range_m > limits_.range_m)
    return fmt::format("{:.0f} m from the beginning, more than {:g} m", range_m, limits_.range_m);
  return std::nullopt;
}

void Pilot::take(const Reading& reading, double period_s) {
  if (reading.depth_m) state_.depth_m = *reading.depth_m;
  if (reading.rate_rad_s) state_.rate_rad_s = *reading.rate_rad_s;
  state_.euler_rad[0] = reading.roll_rad.value_or(state_.euler_rad[0]);
  state_.euler_rad[1] = reading.pitch_rad.value_or(state_.euler_rad[1]);
  if (reading.heading_rad) {
    const double near_rad = began_s_ ? state_.euler_rad[2] : mission_.mission().start.heading_rad;
    state_.euler_rad[2] = nearest_heading(*reading.heading_rad, near_rad);
  }
  state_.surge_m_s = reading.speed_m_s.value_or(surge_for(vehicle_, mission_.last().shaft_rps));
  const double way_m = state_.surge_m_s * period_s;
  mission_.add_way(way_m);
  const double level_m = way_m * std::cos(state_.euler_rad[1]);
  reckoned_m_[0] += level_m * std::cos(state_.euler_rad[2]);
  reckoned_m_[1] += level_m * std::sin(state_.euler_rad[2]);
  offset_m_ = reckoned_m_;
  if (!reading.latitude_rad || !reading.longitude_rad) return;
  if (!plane_) {
    plane_.emplace(*reading.latitude_rad, *reading.longitude_rad);
    first_reckoned_m_ = reckoned_m_;
  }
  offset_m_ = plane_->position_m(*reading.latitude_rad, *reading.longitude_rad);
  for (std::size_t i = 0; i < 2; ++i) offset_m_[i] += first_reckoned_m_[i];
}

Orders Pilot::next(const Reading& reading, double now_s) {
  const bool first = !began_s_;
  const double period_s =
      last_s_ ? std::clamp(now_s - *last_s_, 0.0, kLongestPeriod_s) : vehicle_.autopilot.period_s;
  take(reading, first ? 0 : period_s);
  if (first) began_s_ = now_s;
  last_s_ = now_s;
  if (!stopping()) {
    if (auto reason = alarm(reading, now_s)) stop(std::move(reason), now_s);
  }
  if (!stopping()) {
    Orders orders = mission_.next(state_, period_s);
    if (!mission_.finished()) return orders;
    stop(std::nullopt, now_s);
  }
  return stopping_orders(reading, now_s, period_s);
}

void Pilot::stop(std::optional<std::string> reason, double now_s) {
  if (stopping()) return;
  stopped_at_s_ = now_s;
  stopped_heading_rad_ = state_.euler_rad[2];
  reason_ = std::move(reason);
}

bool Pilot::stopped(double now_s) const {
  if (!stopped_at_s_) return false;
  return now_s - *stopped_at_s_ > (state_.depth_m > kSurface_m ? kRise_s : kSurface_s);
}

bool Pilot::can_steer(const Reading& reading) const {
  return reading.heading_rad && reading.pitch_rad && reading.rate_rad_s && reading.depth_m &&
         !is_silent(reading.compass_age_s, limits_.age_s) && !is_silent(reading.imu_age_s, limits_.age_s);
}

Orders Pilot::stopping_orders(const Reading& reading, double now_s, double period_s) {
  if (stopped(now_s) || state_.depth_m < kSurface_m || !can_steer(reading)) return {};
  const Demand up{.heading_rad = stopped_heading_rad_, .depth_m = kSurface_m / 2};
  Orders orders = to_surface_.orders(up, state_, period_s);
  orders.shaft_rps = 0;
  return orders;
}

}  // namespace navcal::autopilot
