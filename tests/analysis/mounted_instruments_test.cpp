// SPDX-License-Identifier: Apache-2.0
// Instruments that are turned in the vehicle and away from its origin: from their bytes to the estimate, against
// the true motion. With the mounting in the configuration the errors must be those of instruments that sit
// straight at the origin.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "base/angles.h"
#include "base/local_plane.h"
#include "config/mission_file.h"
#include "pipeline/pipeline.h"
#include "sim/recording.h"
#include "sim/vehicle/mission_helm.h"
#include "sim/vehicle/simulated_motion.h"

namespace navcal::analysis {
namespace {

constexpr std::int64_t kMissionBegin_ns = 1'767'225'600'000'000'000, kMissionStep_ns = 100'000'000;
constexpr double kMission_s = 120, kSettled_s = 30;
const double kDeclination_rad = std::atan2(0.6, 19.0);
enum MountedPort : std::size_t { compass_port, imu_port, gps_port, motor_port };

double squared(double value) { return value * value; }

/// Root mean squares of what the estimate is off, once it has settled.
struct MountedErrors {
  double roll_deg = 0, pitch_deg = 0, heading_deg = 0, depth_m = 0, position_m = 0, yaw_rate_deg_s = 0;
};

/// Compares each estimate with the true motion while that is remembered.
class AgainstTruth : public pipeline::Sink {
 public:
  explicit AgainstTruth(const sim::Motion& motion) : motion_(motion) {}

  void on_sample(const instruments::Sample& sample) override {
    if (const auto* compass = std::get_if<instruments::CompassSample>(&sample.value))
      tilts_by_accelerometers += compass->tilt_by_accelerometers ? 1 : 0;
    const auto* imu = std::get_if<instruments::ImuSample>(&sample.value);
    if (imu == nullptr || !is_settled(sample.stamp.validity_ns)) return;
    const double truth_rad_s = motion_.at(sample.stamp.validity_ns).rate_rad_s[2];
    sums_.yaw_rate_deg_s +=
        squared(imu->yaw_rate_calibrated_rad_s.value_or(imu->rate_rad_s.value()[2]) - truth_rad_s);
    ++frames_;
  }
  void on_navigation(const pipeline::NavigationSample& sample) override {
    const auto& estimate = sample.estimate;
    if (!is_settled(estimate.time_ns) || !estimate.heading_rad || !estimate.roll_rad || !estimate.depth_m) return;
    const sim::State truth = motion_.at(estimate.time_ns);
    sums_.roll_deg += squared(*estimate.roll_rad - truth.euler_rad[0]);
    sums_.pitch_deg += squared(*estimate.pitch_rad - truth.euler_rad[1]);
    sums_.heading_deg += squared(base::wrapped(*estimate.heading_rad - truth.euler_rad[2]));
    sums_.depth_m += squared(*estimate.depth_m - truth.position_m[2]);
    if (sample.latitude_rad) {
      const sim::Origin origin;
      const base::LocalPlane plane(origin.latitude_deg * base::kRadiansPerDegree,
                                   origin.longitude_deg * base::kRadiansPerDegree);
      const auto [north_m, east_m] = plane.position_m(*sample.latitude_rad, *sample.longitude_rad);
      sums_.position_m += squared(north_m - truth.position_m[0]) + squared(east_m - truth.position_m[1]);
    }
    ++estimates_;
  }
  [[nodiscard]] MountedErrors errors() const {
    EXPECT_GT(estimates_, 50);
    const auto root = [](double sum, int count) { return std::sqrt(sum / std::max(1, count)); };
    const auto degrees = [&](double sum, int count) { return root(sum, count) * base::kDegreesPerRadian; };
    return {degrees(sums_.roll_deg, estimates_),    degrees(sums_.pitch_deg, estimates_),
            degrees(sums_.heading_deg, estimates_), root(sums_.depth_m, estimates_),
            root(sums_.position_m, estimates_),     degrees(sums_.yaw_rate_deg_s, frames_)};
  }
  int tilts_by_accelerometers = 0;

 private:
  [[nodiscard]] static bool is_settled(std::int64_t time_ns) {
    return static_cast<double>(time_ns - kMissionBegin_ns) * 1e-9 > kSettled_s;
  }

  const sim::Motion& motion_;
  MountedErrors sums_;
  int estimates_ = 0, frames_ = 0;
};

config::Settings settings_of(const devices::InstrumentModel& instruments) {
  config::Settings settings;
  settings.ports = sim::recording_ports(instruments);
  settings.environment.declination_rad = kDeclination_rad;
  return settings;
}

struct MountedRun {
  MountedErrors errors;
  int tilts_by_accelerometers = 0;
};

/// Sails a mission with the instruments as `mounted` and the pipeline set to `settings`. `in_place_of_compass`:
/// bytes at a time that a device of another kind sends there; empty: the compass's own.
MountedRun sailed(const devices::InstrumentModel& mounted, const config::Settings& settings,
                  const std::function<std::string(const sim::State&)>& in_place_of_compass = {}) {
  sim::EffectSet none(kMissionBegin_ns);
  const config::VehicleSettings vehicle;
  const sim::SimulatedMotion motion(vehicle,
                                    std::make_unique<sim::MissionHelm>(vehicle, config::load_mission("survey")),
                                    {kMissionBegin_ns, &none, 20});
  sim::Recording::Options options;
  options.begin_ns = kMissionBegin_ns;
  options.seed = 5;
  options.sky_always_seen = true;
  options.instruments = mounted;
  sim::Recording recording(options, motion);
  pipeline::Pipeline pipeline(settings);
  AgainstTruth truth(motion);
  for (std::int64_t now_ns = kMissionBegin_ns;
       now_ns < kMissionBegin_ns + static_cast<std::int64_t>(kMission_s * 1e9);) {
    now_ns += kMissionStep_ns;
    std::vector<sim::LineRead> reads;
    recording.advance(now_ns, reads);
    for (const sim::LineRead& read : reads) {
      const auto port = static_cast<std::uint16_t>(read.of);
      if (read.sent || (port == compass_port && in_place_of_compass)) continue;
      pipeline.bytes(port, read.time_ns, read.bytes, truth);
    }
    if (!in_place_of_compass) continue;
    const std::string line = in_place_of_compass(motion.at(now_ns));
    pipeline.bytes(compass_port, now_ns, {reinterpret_cast<const std::uint8_t*>(line.data()), line.size()}, truth);
  }
  return {truth.errors(), truth.tilts_by_accelerometers};
}

const MountedRun& straight() {
  static const MountedRun run = sailed({}, settings_of({}));
  return run;
}

/// Rotations any way for the card; a TCM2 does not work beyond 50 degrees of tilt.
devices::InstrumentModel any_mounting(std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> tilt_deg(-25, 25), any_deg(-180, 180), place_m(-0.8, 0.8);
  devices::InstrumentModel model;
  model.compass.mounting.rotation_deg = {tilt_deg(random), tilt_deg(random), any_deg(random)};
  model.imu.mounting.rotation_deg = {any_deg(random), any_deg(random) / 2, any_deg(random)};
  for (double& coordinate : model.imu.mounting.position_m) coordinate = place_m(random);
  for (double& coordinate : model.gps.mounting.position_m) coordinate = 3 * place_m(random);
  return model;
}

void expect_no_worse(const MountedErrors& errors, const MountedErrors& than) {
  // A third is what noise along other axes and another rounding do.
  EXPECT_LT(errors.roll_deg, 1.3 * than.roll_deg + 0.1);
  EXPECT_LT(errors.pitch_deg, 1.3 * than.pitch_deg + 0.1);
  EXPECT_LT(errors.heading_deg, 1.3 * than.heading_deg + 0.3);
  EXPECT_LT(errors.depth_m, 1.3 * than.depth_m + 0.01);
  EXPECT_LT(errors.position_m, 1.3 * than.position_m + 0.1);
  EXPECT_LT(errors.yaw_rate_deg_s, 1.3 * than.yaw_rate_deg_s + 0.1);
}

TEST(MountedInstruments, WithTheMountingConfiguredTheErrorsAreThoseOfStraightInstruments) {
  for (std::uint32_t seed = 1; seed <= 4; ++seed) {
    SCOPED_TRACE(seed);
    const devices::InstrumentModel mounted = any_mounting(seed);
    expect_no_worse(sailed(mounted, settings_of(mounted)).errors, straight().errors);
  }
}

TEST(MountedInstruments, WithoutTheConfigurationEachMountingShows) {
  const MountedErrors& good = straight().errors;
  devices::InstrumentModel compass;
  compass.compass.mounting.rotation_deg = {0, 0, 20};
  EXPECT_GT(sailed(compass, settings_of({})).errors.heading_deg, 10);
  devices::InstrumentModel antenna;
  antenna.gps.mounting.position_m = {4, 0, 0};
  EXPECT_GT(sailed(antenna, settings_of({})).errors.position_m, good.position_m + 2);
  devices::InstrumentModel card;
  card.imu.mounting.position_m = {0, 0, 0.5};
  EXPECT_NEAR(sailed(card, settings_of({})).errors.depth_m, 0.5, 0.05);
}

/// An electronic compass without inclinometer that looks `yaw_deg` aside.
std::function<std::string(const sim::State&)> nmea_compass(double yaw_deg) {
  return [yaw_deg](const sim::State& state) {
    const double heading_deg =
        base::positive_angle(state.euler_rad[2] - kDeclination_rad + yaw_deg * base::kRadiansPerDegree) *
        base::kDegreesPerRadian;
    const std::string body = fmt::format("HCHDM,{:.1f},M", heading_deg);
    unsigned checksum = 0;
    for (const char c : body) checksum ^= static_cast<unsigned char>(c);
    return fmt::format("${}*{:02X}\r\n", body, checksum);
  };
}

config::Settings with_nmea_compass(const devices::InstrumentModel& card, double yaw_deg) {
  config::Settings settings = settings_of(card);
  settings.ports[compass_port].protocol = protocols::Protocol::nmea;
  settings.ports[compass_port].mounting.rotation_deg = {0, 0, yaw_deg};
  return settings;
}

TEST(MountedInstruments, ATiltedCardGivesRollAndPitchToACompassThatHasNone) {
  const auto level = sailed({}, with_nmea_compass({}, 0), nmea_compass(0));
  EXPECT_GT(level.tilts_by_accelerometers, 800);
  EXPECT_LT(level.errors.roll_deg, 2);
  EXPECT_LT(level.errors.pitch_deg, 2);
  EXPECT_LT(level.errors.heading_deg, 3);
  devices::InstrumentModel card;
  card.imu.mounting.rotation_deg = {170, 30, -60};
  card.imu.mounting.position_m = {0.6, -0.2, 0.1};
  const auto tilted = sailed(card, with_nmea_compass(card, 90), nmea_compass(90));
  EXPECT_GT(tilted.tilts_by_accelerometers, 800);
  expect_no_worse(tilted.errors, level.errors);
  const auto not_configured = sailed(card, with_nmea_compass({}, 0), nmea_compass(0));
  EXPECT_GT(not_configured.errors.pitch_deg, 20);
}

}  // namespace
}  // namespace navcal::analysis
