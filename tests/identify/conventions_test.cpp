// SPDX-License-Identifier: Apache-2.0
#include "identify/conventions/conventions.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <numbers>

#include "identify/data/actuator_inputs.h"
#include "tests/identify/identification_case.h"

namespace navcal::identify {
namespace {

using Fault = std::function<void(const config::Layout&, RecordedMotion&)>;

std::vector<Reading>& of(RecordedMotion& motion, Channel channel) {
  return motion.channels[static_cast<std::size_t>(channel)];
}
Channel after(Channel first, std::size_t i) { return static_cast<Channel>(static_cast<std::size_t>(first) + i); }

void each(RecordedMotion& motion, Channel channel, const std::function<double(double)>& change) {
  for (Reading& reading : of(motion, channel)) {
    reading.value = change(reading.value);
    if (channel == Channel::heading) reading.value = std::remainder(reading.value, 2 * std::numbers::pi);
  }
}
void times(RecordedMotion& motion, Channel first, std::size_t n, double factor) {
  for (std::size_t i = 0; i < n; ++i) each(motion, after(first, i), [&](double x) { return factor * x; });
}

/// "rov" with fixes; the Doppler log may sit away from the origin.
RecordedMotion dive(const config::Layout& layout, std::uint64_t seed, const Eigen::Vector3d& doppler_m) {
  VehicleCase vehicle = vehicle_case("rov");
  for (const Channel channel : {Channel::north, Channel::east}) vehicle.channels.push_back({channel, 1, 0.1});
  RecordedMotion motion = draw_recording(vehicle, layout, 60, seed, 0.3);
  motion.doppler_place_m = doppler_m;
  for (std::size_t k = 0; k < of(motion, Channel::bottom_x).size(); ++k) {
    Eigen::Vector3d rate;
    const double time_s = of(motion, Channel::bottom_x)[k].time_s;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto& rates = motion[after(Channel::rate_x, i)];
      const auto near = std::min_element(rates.begin(), rates.end(), [&](const Reading& a, const Reading& b) {
        return std::abs(a.time_s - time_s) < std::abs(b.time_s - time_s);
      });
      rate[static_cast<Eigen::Index>(i)] = near->value;
    }
    const Eigen::Vector3d lever = rate.cross(doppler_m);
    for (std::size_t i = 0; i < 3; ++i)
      of(motion, after(Channel::bottom_x, i))[k].value += lever[static_cast<Eigen::Index>(i)];
  }
  motion.declination_rad = 0.3;
  each(motion, Channel::heading, [](double x) { return x - 0.3; });
  return motion;
}

Signal& command(const config::Layout& layout, RecordedMotion& motion, std::size_t thruster) {
  for (const std::string& name : signals_of_thruster(layout, thruster))
    if (const auto found = motion.signals.find(name); found != motion.signals.end()) return found->second;
  throw std::logic_error("no command");
}

struct Row {
  std::string name;
  Fault fault;
};
const std::vector<Row> kFaults{
    {"axis_swapped",
     [](const auto&, RecordedMotion& m) { std::swap(of(m, Channel::rate_x), of(m, Channel::rate_y)); }},
    {"axis_swapped",
     [](const auto&, RecordedMotion& m) { std::swap(of(m, Channel::force_y), of(m, Channel::force_z)); }},
    {"sign", [](const auto&, RecordedMotion& m) { times(m, Channel::rate_z, 1, -1); }},
    {"sign", [](const auto&, RecordedMotion& m) { times(m, Channel::gauge_depth, 1, -1); }},
    {"degrees_for_radians",
     [](const auto&, RecordedMotion& m) { times(m, Channel::rate_x, 3, 180 / std::numbers::pi); }},
    {"degrees_for_radians",
     [](const auto&, RecordedMotion& m) { times(m, Channel::heading, 1, std::numbers::pi / 180); }},
    {"gravity", [](const auto&, RecordedMotion& m) { times(m, Channel::force_x, 3, -1); }},
    {"gravity", [](const auto&, RecordedMotion& m) { times(m, Channel::force_x, 3, 1 / 9.80665); }},
    {"north_east", [](const auto&, RecordedMotion& m) { std::swap(of(m, Channel::north), of(m, Channel::east)); }},
    {"north_east",
     [](const auto&, RecordedMotion& m) {
       each(m, Channel::heading, [](double x) { return std::numbers::pi / 2 - x; });
     }},
    {"body_frame",
     [](const auto&, RecordedMotion& m) {
       times(m, Channel::rate_y, 2, -1);
       times(m, Channel::force_y, 2, -1);
       times(m, Channel::bottom_y, 2, -1);
       times(m, Channel::pitch, 1, -1);
     }},
    {"declination_twice",
     [](const auto&, RecordedMotion& m) { each(m, Channel::heading, [](double x) { return x + 0.3; }); }},
    {"actuator_order",
     [](const auto& layout, RecordedMotion& m) { std::swap(command(layout, m, 0), command(layout, m, 2)); }},
    {"actuator_reversed",
     [](const auto& layout, RecordedMotion& m) {
       Signal& signal = command(layout, m, 1);
       const double neutral = sim::ActuatorValues::neutral(layout).thrusters[1];
       for (double& value : signal.values) value = 2 * (signal.is_pulse ? 1500 : neutral) - value;
     }},
    {"dvl_frame",
     [](const auto&, RecordedMotion& m) {
       auto &x = of(m, Channel::bottom_x), &y = of(m, Channel::bottom_y);
       for (std::size_t k = 0; k < std::min(x.size(), y.size()); ++k) {
         const double forward = (x[k].value + y[k].value) / std::numbers::sqrt2;
         y[k].value = (y[k].value - x[k].value) / std::numbers::sqrt2;
         x[k].value = forward;
       }
     }},
    {"lever_arm_sign", [](const auto&, RecordedMotion& m) { m.doppler_place_m = -m.doppler_place_m; }},
    {"time_zone", [](const auto&, RecordedMotion& m) {
       for (const Channel channel : {Channel::north, Channel::east})
         for (Reading& reading : of(m, channel)) reading.time_s += 7200;
       m.duration_s += 7200;
     }}};

std::string words(const ConventionCheck& check) {
  std::string out;
  for (const Convention& convention : check.found)
    out += convention.name + " of " + convention.what + ": " + convention.sentence + "\n";
  return out;
}

ConventionCheck checked(const config::Layout& layout, RecordedMotion motion) {
  return check_conventions(layout, {std::move(motion)}, [](double) {});
}

TEST(Conventions, EachIsNamedFromAMinuteOfAVehicleThatIsNotItsLayout) {
  const VehicleCase vehicle = vehicle_case("rov");
  const config::Layout truth = draw_vehicle(vehicle, 5).layout;
  for (std::size_t i = 0; i < kFaults.size(); ++i) {
    // The heading's offset is drawn, too; where it is large, nobody can say that a declination is in it twice.
    RecordedMotion motion = dive(truth, 60 + i, {0.4, -0.3, 0.2});
    kFaults[i].fault(vehicle.prior, motion);
    const ConventionCheck check = checked(vehicle.prior, motion);
    ASSERT_FALSE(check.found.empty()) << kFaults[i].name << " " << i;
    for (const Convention& convention : check.found)
      EXPECT_EQ(convention.name, kFaults[i].name) << i << ": " << words(check);
    EXPECT_GT(check.found.front().probability, 0.5);
  }
}

TEST(Conventions, NothingIsFoundWhereNothingIsWrong) {
  for (const std::string name : {"rov", "rov-imu", "micro", "reference"}) {
    const VehicleCase vehicle = vehicle_case(name);
    const config::Layout truth = draw_vehicle(vehicle, 6).layout;
    const ConventionCheck check = checked(vehicle.prior, draw_recording(vehicle, truth, 60, 60));
    EXPECT_TRUE(check.found.empty()) << name << ": " << words(check);
  }
}

TEST(Conventions, TwoAreFoundTogether) {
  const VehicleCase vehicle = vehicle_case("rov");
  RecordedMotion motion = dive(vehicle.prior, 70, Eigen::Vector3d::Zero());
  times(motion, Channel::rate_x, 3, 180 / std::numbers::pi);
  times(motion, Channel::force_x, 3, -1);
  const ConventionCheck check = checked(vehicle.prior, motion);
  ASSERT_EQ(check.found.size(), 2U) << words(check);
  EXPECT_NE(check.found[0].name, check.found[1].name);
}

TEST(Conventions, ATimeZoneIsToldOfComparedChannelsWithEnoughReadingsOnly) {
  const VehicleCase vehicle = vehicle_case("rov");
  const auto beside = [](double first_s, int count, double period_s) {
    Signal signal;
    for (int i = 0; i < count; ++i) {
      signal.times_s.push_back(first_s + period_s * i);
      signal.values.push_back(1);
    }
    return signal;
  };
  // As a glider logs them: sensors of other things, of which some say one word at the start.
  RecordedMotion motion = dive(vehicle.prior, 71, Eigen::Vector3d::Zero());
  motion.signals["science_is_installed"] = beside(-1800, 1, 1);
  motion.signals["science_voltage"] = beside(-1800, 60, 1);
  // Fixes at the surface, half an hour before the dive.
  for (const Channel channel : {Channel::north, Channel::east}) {
    auto& fixes = of(motion, channel);
    fixes.resize(25);
    for (std::size_t i = 0; i < fixes.size(); ++i) fixes[i].time_s = -1800 + static_cast<double>(i);
  }
  const ConventionCheck check = checked(vehicle.prior, motion);
  EXPECT_TRUE(check.found.empty()) << words(check);
}

TEST(Conventions, AVehicleThatRestsTellsNothing) {
  const VehicleCase vehicle = vehicle_case("micro");
  RecordedMotion motion = draw_recording(vehicle, vehicle.prior, 60, 61);
  for (std::size_t c = 0; c < kChannels; ++c)
    for (Reading& reading : motion.channels[c])
      reading.value = static_cast<Channel>(c) == Channel::force_z ? -9.81 : reading.value * 1e-3;
  for (auto& [name, signal] : motion.signals)
    std::fill(signal.values.begin(), signal.values.end(), signal.is_pulse ? 1500.0 : 0.0);
  const ConventionCheck check = checked(vehicle.prior, motion);
  EXPECT_TRUE(check.found.empty());
  EXPECT_EQ(std::ranges::count(check.untold, "rate_z reversed"), 1);
}

TEST(Conventions, WhatAMotionDoesNotTellIsSaid) {
  const VehicleCase vehicle = vehicle_case("micro");
  RecordedMotion motion = draw_recording(vehicle, vehicle.prior, 60, 64);
  EXPECT_EQ(std::ranges::count(checked(vehicle.prior, motion).untold, "rate_z reversed"), 0);
  // Without another measure of the turn, and with commands of which none turns it.
  for (const Channel channel : {Channel::heading, Channel::second_yaw_rate}) of(motion, channel).clear();
  motion.signals.clear();
  EXPECT_EQ(std::ranges::count(checked(vehicle.prior, motion).untold, "heading reversed"), 0)
      << "it is not measured";
}

TEST(Conventions, ADeadThrusterIsNoWrongOrder) {
  const VehicleCase vehicle = vehicle_case("rov");
  config::Layout truth = vehicle.prior;
  truth.thrusters[3].force_scale = 0;
  const ConventionCheck check = checked(vehicle.prior, draw_recording(vehicle, truth, 60, 62));
  EXPECT_TRUE(check.found.empty()) << words(check);
}

TEST(Conventions, WhatIsMissingIsSaid) {
  const VehicleCase vehicle = vehicle_case("micro");
  RecordedMotion motion = draw_recording(vehicle, vehicle.prior, 30, 63);
  motion.name = "dive.mcap";
  motion.signals.clear();
  const ConventionCheck check = checked(vehicle.prior, motion);
  ASSERT_FALSE(check.not_checked.empty());
  EXPECT_NE(check.not_checked.front().find("dive.mcap"), std::string::npos);
  EXPECT_TRUE(checked(vehicle.prior, RecordedMotion{}).found.empty());
}

}  // namespace
}  // namespace navcal::identify
