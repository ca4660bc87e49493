// SPDX-License-Identifier: Apache-2.0
#include "identify/conventions/suspects.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>

#include "base/angles.h"
#include "base/gravity.h"
#include "identify/data/gridded.h"
#include "identify/replay/motion_point.h"

namespace navcal::identify {
namespace {

using MotionChange = Suspect::MotionChange;
constexpr double kDegrees = base::kDegreesPerRadian;
constexpr double kUsual = 2.5;  ///< log prior beside what looks the same where little is measured

std::vector<Reading>& readings(RecordedMotion& motion, Channel channel) {
  return motion.channels[static_cast<std::size_t>(channel)];
}
Channel next_of(Channel first, std::size_t i) { return static_cast<Channel>(static_cast<std::size_t>(first) + i); }

MotionChange scaled(const std::vector<Channel>& channels, double factor, double offset = 0) {
  return [=](RecordedMotion& motion) {
    for (const Channel channel : channels) {
      // Angles were wrapped after the error was made.
      double whole = 0, last = 0;
      for (Reading& reading : readings(motion, channel)) {
        if (describe(channel).is_angle) {
          whole += base::wrapped(reading.value - last);
          last = reading.value;
          reading.value = whole;
        }
        reading.value = factor * reading.value + offset;
        reading.std *= std::abs(factor);
      }
    }
  };
}
MotionChange swapped(Channel a, Channel b) {
  return [=](RecordedMotion& motion) { std::swap(readings(motion, a), readings(motion, b)); };
}
MotionChange all_of(const std::vector<MotionChange>& changes) {
  return [=](RecordedMotion& motion) {
    for (const auto& change : changes) change(motion);
  };
}

/// Turns vectors of three channels; `by` also gets the attitude then.
using VectorTurn = std::function<Eigen::Vector3d(const Eigen::Vector3d& vector, const Eigen::Matrix3d& world)>;
MotionChange turned(Channel first, const VectorTurn& by) {
  return [=](RecordedMotion& motion) {
    const std::size_t rows = grid_rows(motion);
    std::array<std::vector<double>, 3> angles;
    for (std::size_t i = 0; i < 3; ++i) {
      angles[i] = on_grid(motion, next_of(Channel::roll, i), rows);
      if (!motion.has(next_of(Channel::roll, i))) angles[i].assign(rows, 0.0);
    }
    auto &x = readings(motion, first), &y = readings(motion, next_of(first, 1)),
         &z = readings(motion, next_of(first, 2));
    for (std::size_t k = 0; k < std::min({x.size(), y.size(), z.size()}); ++k) {
      const auto row = std::min(static_cast<std::size_t>(std::max(0.0, x[k].time_s) / kGrid_s), rows - 1);
      const Eigen::Vector3d out = by({x[k].value, y[k].value, z[k].value},
                                     world_from_body({angles[0][row], angles[1][row], angles[2][row]}));
      x[k].value = out.x();
      y[k].value = out.y();
      z[k].value = out.z();
    }
    for (std::size_t i = 0; i < 3; ++i)
      std::erase_if(readings(motion, next_of(first, i)),
                    [](const Reading& reading) { return !std::isfinite(reading.value); });
  };
}

/// A sensor of three axes.
struct Triad {
  Channel first;
  std::string_view name, words;
};
constexpr std::array<Triad, 4> kTriads{{{Channel::rate_x, "rate", "the rates"},
                                        {Channel::force_x, "force", "the specific force"},
                                        {Channel::bottom_x, "bottom", "the velocity over the bottom"},
                                        {Channel::water_x, "water", "the velocity through the water"}}};
constexpr std::array<char, 3> kAxisLetters{'x', 'y', 'z'};

std::string of_axis(const Triad& triad, std::size_t i) {
  return fmt::format("{}_{}", triad.name, kAxisLetters[i]);
}

void add_triad(const Triad& triad, std::vector<Suspect>& out) {
  const auto axis = [&](std::size_t i) { return next_of(triad.first, i); };
  for (std::size_t i = 0; i < 3; ++i) {
    out.push_back({"sign", of_axis(triad, i), of_axis(triad, i) + " reversed", scaled({axis(i)}, -1)});
    const std::size_t j = (i + 1) % 3;
    out.push_back({"axis_swapped", of_axis(triad, i) + ", " + of_axis(triad, j),
                   fmt::format("{} and {} exchanged", of_axis(triad, i), of_axis(triad, j)),
                   swapped(axis(i), axis(j))});
  }
  const std::string name(triad.name), words(triad.words);
  if (triad.first != Channel::force_x)
    out.push_back(
        {"sign", name, words + " reversed", scaled({axis(0), axis(1), axis(2)}, -1), Suspect::kNothing, -kUsual});
  out.push_back({"body_frame", name, words + " turned from forward, left, up to forward, right, down",
                 scaled({axis(1), axis(2)}, -1), Suspect::kNothing, -kUsual});
}

MotionChange to_frd() {
  std::vector<Channel> channels{Channel::pitch};
  for (const Triad& triad : kTriads)
    channels.insert(channels.end(), {next_of(triad.first, 1), next_of(triad.first, 2)});
  return scaled(channels, -1);
}

}  // namespace

std::vector<Suspect> suspects_of_instruments(const RecordedMotion& motion) {
  std::vector<Suspect> out;
  for (const Triad& triad : kTriads)
    if (motion.has(triad.first)) add_triad(triad, out);
  out.push_back(
      {"body_frame", "body", "body axes turned from forward, left, up to forward, right, down", to_frd()});
  for (const auto& [channel, name] : {std::pair{Channel::roll, "roll"},
                                      {Channel::pitch, "pitch"},
                                      {Channel::heading, "heading"},
                                      {Channel::second_yaw_rate, "second_yaw_rate"},
                                      {Channel::depth, "depth"},
                                      {Channel::gauge_depth, "gauge_depth"}})
    out.push_back({"sign", name, fmt::format("{} reversed", name), scaled({channel}, -1)});
  const auto in_degrees = [&](const std::string& what, const std::vector<Channel>& channels) {
    for (const auto& [unit, factor] : {std::pair{"degrees", 1 / kDegrees}, {"radians", kDegrees}})
      out.push_back(
          {"degrees_for_radians", what, fmt::format("{} taken in {}", what, unit), scaled(channels, factor)});
    out.push_back({"", what, "", scaled(channels, 0)});  // noise agrees better the less of it there is
  };
  in_degrees("roll, pitch", {Channel::roll, Channel::pitch});
  in_degrees("heading", {Channel::heading});
  in_degrees("roll, pitch, heading", {Channel::roll, Channel::pitch, Channel::heading});
  in_degrees("rate", {Channel::rate_x, Channel::rate_y, Channel::rate_z});
  out.push_back(
      {"axis_swapped", "roll, pitch", "roll and pitch exchanged", swapped(Channel::roll, Channel::pitch)});
  const std::vector<Channel> forces{Channel::force_x, Channel::force_y, Channel::force_z};
  out.push_back({"gravity", "force", "the accelerometers' sign reversed", scaled(forces, -1)});
  out.push_back({"gravity", "force", "the specific force in units of g", scaled(forces, base::kGravity_m_s2)});
  for (const double sign : {1.0, -1.0})
    out.push_back({"gravity", "force", "gravity in the specific force again",
                   turned(Channel::force_x, [sign](const auto& force, const auto& world) -> Eigen::Vector3d {
                     return sign * force - base::kGravity_m_s2 * world.row(2).transpose();
                   })});

  const MotionChange places = swapped(Channel::north, Channel::east);
  const MotionChange velocities = swapped(Channel::north_velocity, Channel::east_velocity);
  const MotionChange headings = scaled({Channel::heading}, -1, std::numbers::pi / 2);
  out.push_back({"north_east", "position", "north and east of the position exchanged", places});
  out.push_back({"north_east", "velocity", "north and east of the receiver's velocity exchanged", velocities});
  out.push_back({"north_east", "position, velocity", "north and east exchanged", all_of({places, velocities})});
  out.push_back({"north_east", "heading", "the heading counted from north, clockwise", headings});
  out.back().log_prior = kUsual;
  out.push_back({"north_east", "position, velocity, heading",
                 "north and east exchanged, and the heading from north", all_of({places, velocities, headings})});

  const auto doppler = [&](std::string words, const VectorTurn& by) {
    out.push_back({"dvl_frame", "dvl", "the Doppler log's velocity turned " + std::move(words),
                   all_of({turned(Channel::bottom_x, by), turned(Channel::water_x, by)})});
  };
  doppler("from north, east, down into the body",
          [](const auto& v, const auto& world) -> Eigen::Vector3d { return world.transpose() * v; });
  doppler("from east, north, up into the body", [](const auto& v, const auto& world) -> Eigen::Vector3d {
    return world.transpose() * Eigen::Vector3d(v.y(), v.x(), -v.z());
  });
  for (const double angle_deg : {45.0, -45.0, 90.0, -90.0, 180.0})
    doppler(fmt::format("by {:.0f} degrees", angle_deg),
            [angle_deg](const auto& v, const auto&) -> Eigen::Vector3d {
              return Eigen::AngleAxisd(angle_deg / kDegrees, Eigen::Vector3d::UnitZ()) * v;
            });

  const auto lever = [&](Eigen::Vector3d RecordedMotion::*place, std::string what) {
    if ((motion.*place).norm() > 0)
      out.push_back({"lever_arm_sign", what, fmt::format("the place of {} with the other sign", what),
                     [place](RecordedMotion& of) { of.*place = -(of.*place); }});
  };
  lever(&RecordedMotion::imu_place_m, "imu");
  lever(&RecordedMotion::gauge_place_m, "gauge");
  lever(&RecordedMotion::doppler_place_m, "dvl");
  lever(&RecordedMotion::antenna_place_m, "antenna");
  return out;
}

std::vector<Suspect> suspects_of_actuators(const config::Layout& layout) {
  std::vector<Suspect> out;
  const sim::ActuatorValues neutral = sim::ActuatorValues::neutral(layout);
  using Numbers = sim::ActuatorNumbers sim::ActuatorValues::*;
  const auto change = [&](std::string name, std::string what, std::string words, ActuatorChange actuators,
                          double log_prior = 0) {
    out.push_back({std::move(name), std::move(what), std::move(words), [](RecordedMotion&) {},
                   std::move(actuators), log_prior});
  };
  /// Scales the parts from `first` up to before `end` about neutral.
  const auto scaled_parts = [&](Numbers part, std::size_t first, std::size_t end, double factor) {
    return [=](sim::ActuatorValues& values) {
      for (std::size_t i = first; i < end; ++i) {
        const double rest = (neutral.*part)[i];
        (values.*part)[i] = rest + factor * ((values.*part)[i] - rest);
      }
    };
  };
  for (const auto& [kind, part] : {std::pair<std::string, Numbers>{"thruster", &sim::ActuatorValues::thrusters},
                                   {"surface", &sim::ActuatorValues::surfaces_rad}}) {
    const std::size_t n = (neutral.*part).size();
    for (std::size_t i = 0; i < n; ++i) {
      const std::string one = fmt::format("{}.{}", kind, i + 1);
      change("actuator_reversed", one, one + " reversed", scaled_parts(part, i, i + 1, -1));
      // A fault of the part, which is no convention, must not pass for one.
      change("", one, "", scaled_parts(part, i, i + 1, 0));
      for (std::size_t j = i + 1; j < n; ++j)
        change(
            "actuator_order", fmt::format("{}, {}.{}", one, kind, j + 1),
            fmt::format("{} and {}.{} exchanged", one, kind, j + 1),
            [part = part, i, j](auto& values) { std::swap((values.*part)[i], (values.*part)[j]); },
            -std::log(static_cast<double>(n) * static_cast<double>(n - 1) / 2));
    }
    if (n < 2) continue;
    change("actuator_reversed", kind, fmt::format("all of {} reversed", kind), scaled_parts(part, 0, n, -1));
    change("actuator_order", kind, fmt::format("{} in the opposite order", kind),
           [part = part](auto& values) { std::ranges::reverse(values.*part); });
  }
  const auto surfaces = &sim::ActuatorValues::surfaces_rad;
  for (const auto& [unit, factor] : {std::pair{"degrees", 1 / kDegrees}, {"radians", kDegrees}})
    change("degrees_for_radians", "surface", fmt::format("the surfaces' angles taken in {}", unit),
           scaled_parts(surfaces, 0, neutral.surfaces_rad.size(), factor));
  return out;
}

}  // namespace navcal::identify
