// SPDX-License-Identifier: Apache-2.0
// From the bytes of the emulated instruments to positions: among iron, calibrated on the way, then 120 m below.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <numbers>

#include "base/local_plane.h"
#include "pipeline/pipeline.h"
#include "record/recording.h"
#include "sim/geodesy.h"
#include "tests/cli/simulated_recording.h"
#include "tests/support/temporary_folder.h"

namespace navcal::cli::test {
namespace {

constexpr double kSurface_s = 260, kBelow_s = 120, kStep_s = 0.1;
constexpr double kTurnRate_rad_s = 9 * std::numbers::pi / 180;

/// Circles at the surface and a straight leg; then a dive with two corners; then the surface again.
std::vector<sim::PathRow> dive() {
  auto rows = turning_path(kSurface_s - 20);
  sim::PathRow row = rows.back();
  row.rate_rad_s = {0, 0, 0};
  while (row.t_s < kSurface_s + kBelow_s + 20) {
    const double below_s = row.t_s - kSurface_s;
    const bool turns = (below_s >= 30 && below_s < 40) || (below_s >= 70 && below_s < 80);
    row.t_s += kStep_s;
    row.rate_rad_s[2] = turns ? kTurnRate_rad_s : 0;
    row.euler_rad[2] += row.rate_rad_s[2] * kStep_s;
    row.position_m[0] += std::cos(row.euler_rad[2]) * kStep_s;
    row.position_m[1] += std::sin(row.euler_rad[2]) * kStep_s;
    row.position_m[2] =
        below_s > 0 && below_s < kBelow_s ? std::min({1.0, below_s / 5, (kBelow_s - below_s) / 5}) : 0;
    rows.push_back(row);
  }
  return rows;
}

struct Estimates : pipeline::Sink {
  void on_sample(const instruments::Sample&) override {}
  void on_navigation(const pipeline::NavigationSample& sample) override { samples.push_back(sample); }
  std::vector<pipeline::NavigationSample> samples;
};

class Navigation : public testing::Test {
 protected:
  Estimates replayed(const RecordingOptions& options, bool calibration) {
    const auto file = folder_ / "dive.cap";
    std::ofstream(file, std::ios::binary) << simulated_recording(path_, options);
    const auto recording = record::Recording::open(file);
    auto settings = recording->settings();
    settings.environment.declination_rad = std::atan2(0.6, 19.0);
    settings.calibration.enabled = calibration;
    pipeline::Pipeline pipeline(settings);
    Estimates estimates;
    while (const auto entry = recording->next()) {
      const auto* raw = std::get_if<record::RawRead>(&*entry);
      if (raw != nullptr && raw->direction == record::Direction::received)
        pipeline.bytes(raw->port, raw->time_ns, raw->bytes, estimates);
    }
    return estimates;
  }
  [[nodiscard]] double error_m(const pipeline::NavigationSample& sample, std::int64_t begin_s) const {
    const sim::PathMotion motion(path_, begin_s * 1'000'000'000);
    const auto state = motion.at(sample.stamp.validity_utc_ns);
    const auto truth = sim::geodetic(sim::Origin{}, state.position_m);
    const base::LocalPlane plane(truth[0] * std::numbers::pi / 180, truth[1] * std::numbers::pi / 180);
    const auto [north_m, east_m] = plane.position_m(*sample.latitude_rad, *sample.longitude_rad);
    return std::hypot(north_m, east_m);
  }

  const std::vector<sim::PathRow> path_ = dive();
  ::navcal::test::TemporaryFolder folder_;
};

TEST_F(Navigation, ADiveEndsNearerToItsFixWithTheCalibrationThanWithout) {
  RecordingOptions options;
  options.duration_s = path_.back().t_s;
  options.offset_uT = {6, -4, 2};
  double before_m = 0, after_m = 0, distance_m = 0;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    options.seed = 10 * seed;
    const auto calibrated = replayed(options, true), not_calibrated = replayed(options, false);
    int outages = 0;
    const pipeline::NavigationSample* before_fix = nullptr;
    for (const auto& sample : calibrated.samples) {
      if (sample.outage && sample.outage->distance_m > 50) {
        ++outages;
        ASSERT_NE(before_fix, nullptr);
        ASSERT_NE(sample.calibration.number, 0U);
        distance_m += sample.outage->distance_m;
        const double error = error_m(*before_fix, options.begin_s);
        after_m += error;
        EXPECT_LT(error, 4 * before_fix->estimate.position_std_m.norm());
        std::printf("%s; by the truth %.1f m\n", words_for_outage(sample).c_str(), error);
      }
      if (sample.source == pipeline::PositionSource::reckoned) before_fix = &sample;
    }
    EXPECT_EQ(outages, 1);
    const pipeline::NavigationSample* last = nullptr;
    for (const auto& sample : not_calibrated.samples)
      if (sample.source == pipeline::PositionSource::reckoned) last = &sample;
    ASSERT_NE(last, nullptr);
    before_m += error_m(*last, options.begin_s);
  }
  std::printf("per 100 m: %.2f m before calibration, %.2f m after\n", 100 * before_m / distance_m,
              100 * after_m / distance_m);
  EXPECT_LT(after_m, 0.8 * before_m);
  EXPECT_LT(after_m, 0.06 * distance_m);
}

TEST_F(Navigation, TheSameBytesGiveTheSameEstimates) {
  RecordingOptions options;
  options.duration_s = 60;
  const auto one = replayed(options, true), other = replayed(options, true);
  ASSERT_EQ(one.samples.size(), other.samples.size());
  for (std::size_t i = 0; i < one.samples.size(); ++i) {
    EXPECT_EQ(one.samples[i].latitude_rad, other.samples[i].latitude_rad);
    EXPECT_EQ(one.samples[i].estimate.heading_rad, other.samples[i].estimate.heading_rad);
    EXPECT_EQ(one.samples[i].stamp.validity_utc_ns, other.samples[i].stamp.validity_utc_ns);
  }
}

}  // namespace
}  // namespace navcal::cli::test
