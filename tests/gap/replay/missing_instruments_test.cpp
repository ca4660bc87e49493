// SPDX-License-Identifier: Apache-2.0
// Replays of missions without one of their instruments: its channels are not measured, and the others stay near
// what they are with it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <string>

#include "base/angles.h"
#include "gap/actuators/commanded_motor.h"
#include "gap/inference/biases.h"
#include "gap/inference/linearised.h"
#include "gap/inference/spike_and_slab.h"
#include "tests/gap/simulated_mission.h"

namespace navcal::gap {
namespace {

double settled_rms(const Innovations& innovations, Eigen::Index channel) {
  double square = 0;
  int count = 0;
  for (Eigen::Index i = 300; i < innovations.grid.rows(); ++i) {
    const double value = innovations.grid(i, channel);
    if (!std::isfinite(value)) continue;
    square += value * value;
    ++count;
  }
  return count > 0 ? std::sqrt(square / count) : std::nan("");
}

class MissingInstrument : public testing::Test {
 protected:
  [[nodiscard]] Mission without(std::initializer_list<const char*> names) const {
    Mission mission = whole_;
    for (const char* const name : names) leave_out(quantities_named(name), mission);
    return mission;
  }
  [[nodiscard]] Innovations left_of(const Mission& mission) const {
    const Replay replay(mission, {});
    return replay.run(library_.model(with_biases_found(replay, library_, 1)));
  }
  Mission whole_ = test::simulated_mission("identification", "", 150, 3);
  Library library_ = Library({});
};

TEST_F(MissingInstrument, LeavesItsOwnChannelsUnmeasured) {
  const Innovations no_compass = left_of(without({"compass"}));
  for (const Channel channel : {field_x, field_z, tilt_roll, tilt_pitch, heading}) {
    EXPECT_TRUE(std::isnan(settled_rms(no_compass, channel))) << channel;
  }
  EXPECT_TRUE(std::isfinite(settled_rms(no_compass, gyro_yaw_a)));
  const Innovations no_card = left_of(without({"card"}));
  for (const Channel channel : {gyro_pitch, gyro_yaw_a, gyro_yaw_b, force_x, depth, gyro_roll}) {
    EXPECT_TRUE(std::isnan(settled_rms(no_card, channel))) << channel;
  }
  EXPECT_TRUE(std::isfinite(settled_rms(no_card, field_x)));
  const Innovations no_gps = left_of(without({"gps"}));
  EXPECT_EQ(no_gps.fixes.rows(), 0);
  EXPECT_TRUE(std::isfinite(settled_rms(no_gps, field_x)));
}

TEST_F(MissingInstrument, TheOthersStayNearTheirNoise) {
  EXPECT_LT(settled_rms(left_of(without({"depth"})), field_x), 0.3);
  EXPECT_LT(settled_rms(left_of(without({"accelerometers"})), field_x), 0.3);
  EXPECT_LT(settled_rms(left_of(without({"gps"})), field_x), 0.3);
  EXPECT_LT(settled_rms(left_of(without({"gps", "depth"})), gyro_yaw_a), 0.3 * base::kRadiansPerDegree);
  const Innovations no_tilt = left_of(without({"tilt"}));
  EXPECT_LT(settled_rms(no_tilt, field_x), 0.6) << "levelled by the accelerometers";
  EXPECT_LT(settled_rms(no_tilt, force_y), 0.06);
  EXPECT_LT(settled_rms(left_of(without({"field"})), tilt_pitch), 0.3 * base::kRadiansPerDegree);
  EXPECT_LT(settled_rms(left_of(without({"compass"})), gyro_yaw_a), 0.3 * base::kRadiansPerDegree);
  EXPECT_LT(settled_rms(left_of(without({"card"})), field_x), 3) << "the vehicle model alone carries the attitude";
}

TEST_F(MissingInstrument, ForAWhileLeavesTheRestAsItWas) {
  Mission mission = whole_;
  std::erase_if(mission.compass, [](const CompassReading& r) { return r.time_s > 70 && r.time_s < 110; });
  find_silences(mission);
  const Innovations all = left_of(whole_), some = left_of(mission);
  ASSERT_EQ(all.grid.rows(), some.grid.rows());
  EXPECT_TRUE(std::isnan(some.grid(850, field_x)));
  EXPECT_TRUE(std::isfinite(some.grid(1300, field_x)));
  EXPECT_LT(settled_rms(some, field_x), 2 * settled_rms(all, field_x));
  EXPECT_LT(settled_rms(some, gyro_yaw_a), 2 * settled_rms(all, gyro_yaw_a));
}

TEST_F(MissingInstrument, ACommandedVehicleIsNearTheReportedOne) {
  Mission mission = whole_;
  leave_out(quantities_named("motor"), mission);
  obey_orders(mission, {});
  const Innovations reported = left_of(whole_), commanded = left_of(mission);
  EXPECT_LT(settled_rms(commanded, field_x), 1.5 * settled_rms(reported, field_x));
  EXPECT_LT(settled_rms(commanded, gyro_yaw_a), 1.5 * settled_rms(reported, gyro_yaw_a));
}

/// Names of the effects that a mission hardly shows, by the noise of its instruments.
std::vector<std::string> hardly_shown(const Mission& mission, const Library& library) {
  const Replay replay(mission, {});
  const Whitening whitening = Whitening::nominal(mission.instruments);
  const Linearised linear = linearise({replay, library, whitening, 1}, with_biases_found(replay, library, 1));
  const Priors priors = fit_spike_widths(library, linear.gram, Eigen::MatrixXd(linear.gram.rows(), 0));
  std::vector<std::string> names;
  for (const std::size_t effect : hardly_shown_effects(library, linear.gram, priors)) {
    names.emplace_back(library[effect].name);
  }
  return names;
}

TEST_F(MissingInstrument, HidesWhatOnlyItCouldShow) {
  const auto has = [](const std::vector<std::string>& names, const char* name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  const auto all = hardly_shown(whole_, library_);
  const auto no_gps = hardly_shown(without({"gps"}), library_);
  for (const char* const name : {"declination", "gps_latency", "gps_lever_arm", "water_current"}) {
    EXPECT_TRUE(has(no_gps, name)) << name;
  }
  EXPECT_FALSE(has(no_gps, "hard_iron"));
  const auto no_compass = hardly_shown(without({"compass"}), library_);
  for (const char* const name : {"hard_iron", "soft_iron", "motor_field", "compass_lag", "tilt_offset"}) {
    EXPECT_TRUE(has(no_compass, name)) << name;
  }
  const auto no_card = hardly_shown(without({"card"}), library_);
  for (const char* const name : {"gyro_scale", "accel_bias", "adc_droop", "imu_latency", "depth_scale"}) {
    EXPECT_TRUE(has(no_card, name)) << name;
    EXPECT_FALSE(has(all, name) && std::string(name) != "depth_scale") << name;
  }
  EXPECT_FALSE(has(no_card, "hard_iron"));
  const auto no_depth = hardly_shown(without({"depth"}), library_);
  EXPECT_TRUE(has(no_depth, "depth_scale") && has(no_depth, "depth_temperature"));
  // Fewer instruments never show more.
  const auto hardly_any = hardly_shown(without({"gps", "depth"}), library_);
  for (const auto& name : no_gps) EXPECT_TRUE(has(hardly_any, name.c_str())) << name;
}

}  // namespace
}  // namespace navcal::gap
