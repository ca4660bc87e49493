// SPDX-License-Identifier: Apache-2.0
// A DVL and a pressure gauge on their way from samples to the estimate.
#include <gtest/gtest.h>

#include <cmath>

#include "base/durations.h"
#include "instruments/mounting.h"
#include "pipeline/stages.h"
#include "pipeline/standard_errors.h"

namespace navcal::pipeline {
namespace {

constexpr double kHarbour_rad = 0.65;
enum DvlVehiclePort : std::uint16_t { compass_port, card_port, gps_port, motor_port, dvl_port, gauge_port };

config::Settings dvl_vehicle() {
  using protocols::Protocol;
  config::Settings settings;
  for (const auto protocol : {Protocol::tcm2, Protocol::imu_card, Protocol::oncore, Protocol::motor_card,
                              Protocol::pd0, Protocol::samples})
    settings.ports.emplace_back().protocol = protocol;
  settings.environment.model = false;
  settings.roles.port_names.at(static_cast<std::size_t>(Role::depth)) = "gauge";
  settings.ports[gauge_port].name = "gauge";
  settings.ports[dvl_port].name = "dvl";
  return settings;
}

struct DvlTold : Sink {
  void on_sample(const instruments::Sample&) override {}
  void on_navigation(const NavigationSample& sample) override { newest = sample; }
  NavigationSample newest;
};

/// A vehicle that heads north with the shaft at 10 revolutions a second (0.872 m/s). It drives on in steps of
/// 50 ms; the DVL measures with every fourth.
class DvlVehicle {
 public:
  explicit DvlVehicle(const config::Settings& settings = dvl_vehicle()) : settings_(settings), stages_(settings) {}

  void give(DvlVehiclePort port, const decltype(instruments::Sample::value)& value) {
    instruments::Sample sample;
    sample.port = port;
    sample.stamp = {now_ns_ + 10 * base::kMillisecond_ns, now_ns_, base::kMillisecond_ns, now_ns_, now_ns_};
    sample.value = value;
    instruments::Mounting(settings_.ports.at(port).mounting).to_body(sample.value);
    StandardErrors(settings_).complete(sample);
    stages_.take(sample, mapping_, told_);
  }
  void fix() {
    instruments::GpsSample gps;
    gps.fix = instruments::Fix::fix_3d;
    gps.latitude_rad = kHarbour_rad;
    gps.longitude_rad = 0;
    give(gps_port, gps);
  }
  void run(double seconds, const std::optional<instruments::DvlSample>& dvl, double pitch_rad = 0) {
    for (int i = 0; i < static_cast<int>(seconds * 20); ++i) {
      now_ns_ += 50 * base::kMillisecond_ns;
      instruments::MotorSample shaft;
      shaft.rpm = 600;
      give(motor_port, shaft);
      instruments::ImuSample card;
      card.rate_rad_s = instruments::Vector3{};
      give(card_port, card);
      instruments::CompassSample word;
      word.heading_rad = 0;
      word.heading_is_true = true;
      word.roll_rad = 0;
      word.pitch_rad = pitch_rad;
      give(compass_port, word);
      if (dvl && i % 4 == 0) give(dvl_port, *dvl);
    }
  }
  [[nodiscard]] const NavigationSample& newest() const { return told_.newest; }
  [[nodiscard]] double north_m() const { return newest().estimate.position_m.value().x(); }
  [[nodiscard]] double east_m() const { return newest().estimate.position_m.value().y(); }

 private:
  config::Settings settings_;
  Stages stages_;
  UtcMapping mapping_{};
  DvlTold told_;
  std::int64_t now_ns_ = 500 * base::kSecond_ns;
};

instruments::DvlSample over_bottom(double ahead_m_s, double starboard_m_s = 0) {
  instruments::DvlSample dvl;
  dvl.bottom_velocity_m_s = instruments::Vector3{ahead_m_s, starboard_m_s, 0};
  return dvl;
}

TEST(DvlStage, BottomVelocityMovesThePosition) {
  DvlVehicle vehicle;
  vehicle.run(1, std::nullopt);
  EXPECT_FALSE(vehicle.newest().bottom_lock);
  vehicle.fix();
  vehicle.run(100, over_bottom(1, 0.2));
  EXPECT_NEAR(vehicle.north_m(), 100, 0.5);
  EXPECT_NEAR(vehicle.east_m(), 20, 0.5);
  EXPECT_EQ(vehicle.newest().estimate.speed_source, nav::SpeedSource::bottom);
  EXPECT_EQ(vehicle.newest().bottom_lock, true);
  EXPECT_NEAR(vehicle.newest().estimate.set_m_s.y(), 0.2, 0.01);
}

TEST(DvlStage, WithoutBottomLockTheSetThatWasFoundGoesOn) {
  DvlVehicle vehicle;
  vehicle.run(1, std::nullopt);
  vehicle.fix();
  vehicle.run(60, over_bottom(1, 0.2));
  const double north_m = vehicle.north_m(), east_m = vehicle.east_m();
  vehicle.run(60, instruments::DvlSample{});
  EXPECT_EQ(vehicle.newest().estimate.speed_source, nav::SpeedSource::shaft);
  EXPECT_EQ(vehicle.newest().bottom_lock, false);
  EXPECT_NEAR(vehicle.north_m() - north_m, 60, 1);
  EXPECT_NEAR(vehicle.east_m() - east_m, 12, 1);
  vehicle.run(10, std::nullopt);
  EXPECT_FALSE(vehicle.newest().bottom_lock) << "it is not heard any more";
}

TEST(DvlStage, WaterVelocityTakesThePlaceOfTheShaft) {
  DvlVehicle vehicle;
  vehicle.run(1, std::nullopt);
  vehicle.fix();
  instruments::DvlSample dvl;
  dvl.water_velocity_m_s = instruments::Vector3{0.7, 0.1, 0};
  vehicle.run(100, dvl);
  EXPECT_NEAR(vehicle.north_m(), 70, 0.7);
  EXPECT_NEAR(vehicle.east_m(), 10, 0.3);
  EXPECT_EQ(vehicle.newest().estimate.speed_source, nav::SpeedSource::water);
}

TEST(DvlStage, UpsideDownItIsTurnedByItsMounting) {
  auto settings = dvl_vehicle();
  settings.ports[dvl_port].mounting.rotation_deg = {180, 0, 0};
  DvlVehicle vehicle(settings);
  vehicle.run(1, std::nullopt);
  vehicle.fix();
  vehicle.run(100, over_bottom(1, -0.2));
  EXPECT_NEAR(vehicle.north_m(), 100, 0.5);
  EXPECT_NEAR(vehicle.east_m(), 20, 0.5);
}

TEST(DvlStage, VelocityInEarthAxesIsNotTurned) {
  auto settings = dvl_vehicle();
  settings.ports[dvl_port].mounting.rotation_deg = {0, 0, 60};
  DvlVehicle vehicle(settings);
  vehicle.run(1, std::nullopt);
  vehicle.fix();
  auto dvl = over_bottom(0, 0.5);
  dvl.frame = instruments::VelocityFrame::earth;
  vehicle.run(100, dvl);
  EXPECT_NEAR(vehicle.north_m(), 0, 1);
  EXPECT_NEAR(vehicle.east_m(), 50, 1);
}

TEST(DvlStage, AnErrorStatedAsZeroOrNotAtAllIsNotBelieved) {
  DvlVehicle silent, zero, nonsense;
  auto dvl = over_bottom(1);
  for (DvlVehicle* vehicle : {&silent, &zero, &nonsense}) {
    vehicle->run(1, std::nullopt);
    vehicle->fix();
  }
  silent.run(50, dvl);
  dvl.bottom_velocity_std_m_s = 0;
  zero.run(50, dvl);
  dvl.bottom_velocity_std_m_s = std::nan("");
  nonsense.run(50, dvl);
  EXPECT_EQ(silent.newest().estimate.speed_source, nav::SpeedSource::bottom);
  EXPECT_EQ(zero.newest().estimate.speed_source, nav::SpeedSource::bottom);
  EXPECT_EQ(nonsense.newest().estimate.speed_source, nav::SpeedSource::shaft);
}

TEST(DvlStage, ItsAltitudeIsVerticalAlready) {
  DvlVehicle vehicle;
  auto dvl = over_bottom(1);
  dvl.altitude_m = 8;
  vehicle.run(20, dvl, 0.4);
  EXPECT_NEAR(vehicle.newest().altitude_m.value(), 8, 1e-6);
}

TEST(DepthStage, APressureIsADepthBelowTheOrigin) {
  auto settings = dvl_vehicle();
  settings.ports[gauge_port].mounting.position_m = {0, 0, 0.5};
  settings.navigation.water_density_kg_m3 = 1000;
  settings.navigation.air_pressure_Pa = 100'000;
  DvlVehicle vehicle(settings);
  instruments::DepthSample gauge;
  gauge.pressure_Pa = 100'000 + 1000 * 9.81 * 10;
  for (int i = 0; i < 40; ++i) {
    vehicle.run(0.5, std::nullopt);
    vehicle.give(gauge_port, gauge);
  }
  EXPECT_NEAR(vehicle.newest().estimate.depth_m.value(), 9.5, 1e-3);
  gauge.depth_m = 7.5;
  for (int i = 0; i < 40; ++i) {
    vehicle.run(0.5, std::nullopt);
    vehicle.give(gauge_port, gauge);
  }
  EXPECT_NEAR(vehicle.newest().estimate.depth_m.value(), 7, 0.05) << "the depth that the gauge states comes first";
}

}  // namespace
}  // namespace navcal::pipeline
