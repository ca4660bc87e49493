// SPDX-License-Identifier: Apache-2.0
#include "gap/replay/replay.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/reference_instruments.h"
#include "gap/replay/replay_run.h"
#include "sim/layout/layout_of.h"
#include "sim/vehicle/motor_current.h"

namespace navcal::gap {
namespace {

/// Longest integration step of the vehicle model. With one step for each frame of the card, a vehicle identical
/// to its model would appear to have quicker fins and a late card, by ten standard errors on a zigzag.
constexpr double kLongestPart_s = 0.026;

constexpr double kReference_C = base::reference::kTemperature_C;
constexpr double kTemperatureGain = 0.005;  ///< a reading; the electronics settle within 200 s

/// Temperatures of the electronics, smoothed forward and backward: their noise is as large as a minute's
/// change.
std::vector<double> smoothed_electronics(std::span<const CompassReading> readings) {
  std::vector<double> smooth(readings.size(), kReference_C);
  const auto pass = [&](auto begin, auto end, auto out, double share) {
    std::optional<double> mean;
    int taken = 0;
    for (auto reading = begin; reading != end; ++reading, ++out) {
      if (const auto said = reading->electronics_C) {
        const double gain = std::max(kTemperatureGain, 1.0 / ++taken);
        mean = mean ? *mean + gain * (*said - *mean) : *said;
      }
      *out += share * (mean.value_or(kReference_C) - kReference_C);
    }
  };
  pass(readings.begin(), readings.end(), smooth.begin(), 0.5);
  pass(readings.rbegin(), readings.rend(), smooth.rbegin(), 0.5);
  return smooth;
}

}  // namespace

Replay::Replay(const Mission& mission, const config::VehicleSettings& vehicle)
    : mission_(mission), settings_(vehicle), vehicle_(sim::layout_of(vehicle)),
      track_(mission.motor,
             mission.order_times_s.empty() ? regular_orders(0, mission.duration_s) : mission.order_times_s,
             mission.order_times_s.empty() ? std::span<const Vector3>{} : mission.ordered_fins_rad,
             vehicle.fins.lag_s, mission.instruments.motor, mission.duration_s),
      electronics_C_(smoothed_electronics(mission.compass)) {
  std::vector<double> nominal_A;
  nominal_A.reserve(track_.rows().size());
  for (const auto& row : track_.rows()) nominal_A.push_back(sim::current_A(settings_.propeller, row.shaft_rps));
  current_A_ = track_.current_A(mission.motor, nominal_A);

  // Frames lie in the middle of their share of an interval, so that clock drift does not move one into the next
  // interval.
  // An instrument that begins late is waited for, unless the others are to be judged without it.
  const auto begins_s = [&](const auto& readings, Quantity quantity) {
    return readings.empty() || mission.is_silent(quantity, 0) ? 0.0 : readings.front().time_s;
  };
  const double first_s = std::max({mission.card.front().time_s, begins_s(mission.compass, Quantity::heading),
                                   mission.motor.front().time_s, mission.judged_from_s});
  const auto first =
      std::ranges::find_if(mission.card, [&](const CardReading& reading) { return reading.time_s >= first_s; });
  const double half_frame_s = std::min(0.5 / mission.instruments.imu.timing.rate_Hz, kInterval_s / 2);
  begin_s_ = (first != mission.card.end() ? first->time_s : first_s) - half_frame_s;
  const auto word = std::ranges::find_if(
      mission.compass, [&](const CompassReading& reading) { return reading.time_s >= begin_s_; });
  if (word != mission.compass.end()) {
    const double phase_s = std::fmod(word->time_s - begin_s_, kInterval_s);
    compass_shift_s_ = kInterval_s / 2 - phase_s;
  }
  intervals_ = std::max<Eigen::Index>(
      0, static_cast<Eigen::Index>(
             std::floor((std::min(mission.card.back().time_s, mission.judged_until_s) - begin_s_) / kInterval_s)));
}

Innovations Replay::run_in_steps(const Model& model, double longest_part_s, Trajectory10Hz* course) const {
  return ReplayRun({mission_, settings_, vehicle_, track_.rows(), current_A_, electronics_C_, begin_s_,
                    compass_shift_s_, intervals_, longest_part_s},
                   model)
      .innovations(course);
}

Innovations Replay::run(const Model& model, Trajectory10Hz* course) const {
  return run_in_steps(model, kLongestPart_s, course);
}

Innovations Replay::run_coarsely(const Model& model) const {
  return run_in_steps(model, std::numeric_limits<double>::infinity(), nullptr);
}

}  // namespace navcal::gap
