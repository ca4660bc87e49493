// SPDX-License-Identifier: Apache-2.0
#include "identify/fit/windows.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/angles.h"

namespace navcal::identify {
namespace {

/// The value of the reading next to a time; nullopt: none within `within_s`.
std::optional<double> next_to(const std::vector<Reading>& readings, double time_s, double within_s) {
  const auto after = std::lower_bound(readings.begin(), readings.end(), time_s,
                                      [](const Reading& reading, double time) { return reading.time_s < time; });
  std::optional<double> value;
  double nearest_s = within_s;
  const auto consider = [&](const Reading& reading) {
    if (std::abs(reading.time_s - time_s) > nearest_s) return;
    nearest_s = std::abs(reading.time_s - time_s);
    value = reading.value;
  };
  if (after != readings.end()) consider(*after);
  if (after != readings.begin()) consider(*(after - 1));
  return value;
}

}  // namespace

std::vector<Window> windows_of(const RecordedMotion& motion, double window_s) {
  constexpr double kRunIn_s = 1;
  double first_s = std::numeric_limits<double>::infinity();
  for (const auto& readings : motion.channels) {
    if (!readings.empty()) first_s = std::min(first_s, readings.front().time_s);
  }
  const auto full = static_cast<std::size_t>(std::lround(window_s / ReplayedMotion::kStep_s));
  std::vector<Window> windows;
  // On the grid of the replay, so that it is that of the actuators too.
  double begin_s = std::ceil((first_s + kRunIn_s) / ReplayedMotion::kStep_s) * ReplayedMotion::kStep_s;
  while (begin_s < motion.duration_s) {
    const auto left = static_cast<std::size_t>((motion.duration_s - begin_s) / ReplayedMotion::kStep_s);
    if (left < full / 2 || left < 2) break;
    Window window{begin_s, std::min(full, left), {}};
    for (std::size_t c = 0; c < kChannels; ++c) {
      const auto channel = static_cast<Channel>(c);
      for (const Reading& reading : motion.channels[c]) {
        if (reading.time_s >= begin_s && reading.time_s < window.end_s() && reading.std > 0)
          window.readings.push_back({channel, reading.time_s, reading.value, reading.std});
      }
    }
    begin_s = window.end_s();
    windows.push_back(std::move(window));
  }
  return windows;
}

std::vector<StateVector> guessed_states(const RecordedMotion& motion, const std::vector<Window>& windows,
                                        const sim::LayoutVehicle& vehicle, const ActuatorTrajectory& actuators) {
  constexpr double kNear_s = 1, kFixNear_s = 3;
  std::vector<StateVector> states;
  StateVector now = StateVector::Zero();
  for (const Window& window : windows) {
    const auto set = [&](Eigen::Index state, Channel channel, double within_s) {
      const auto value = next_to(motion[channel], window.begin_s, within_s);
      if (value) now[state] = *value;
      return value.has_value();
    };
    set(0, Channel::north, kFixNear_s);
    set(1, Channel::east, kFixNear_s);
    if (!set(2, Channel::gauge_depth, kNear_s)) set(2, Channel::depth, kNear_s);
    set(3, Channel::roll, kNear_s);
    set(4, Channel::pitch, kNear_s);
    set(5, Channel::heading, kNear_s);
    for (Eigen::Index i = 0; i < 3; ++i) {
      const auto axis = static_cast<std::size_t>(i);
      const auto after = [&](Channel first) {
        return static_cast<Channel>(static_cast<std::size_t>(first) + axis);
      };
      if (!set(6 + i, after(Channel::water_x), kNear_s)) set(6 + i, after(Channel::bottom_x), kNear_s);
      set(9 + i, after(Channel::rate_x), kNear_s);
    }
    now.tail<2>() = now.segment<2>(3);
    states.push_back(now);
    if (const auto replayed =
            replay(vehicle, actuators, 0, window.begin_s, window.steps, now, motion.tilt_lag_s)) {
      now = state_of(replayed->end());
    } else {
      now.segment<6>(6).setZero();
    }
  }
  return states;
}

}  // namespace navcal::identify
