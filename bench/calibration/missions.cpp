// SPDX-License-Identifier: Apache-2.0
#include "bench/calibration/missions.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>
#include <string>

#include "config/mission_file.h"
#include "pipeline/pipeline.h"
#include "sim/path.h"
#include "sim/recording.h"
#include "sim/vehicle/mission_helm.h"
#include "sim/vehicle/simulated_motion.h"

namespace navcal::bench {
namespace {

constexpr std::int64_t kBegin_ns = 1'767'225'600'000'000'000;
constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr double kDegrees = 180 / std::numbers::pi;
/// scale, bias, B, C, D, E.
constexpr std::size_t kCoefficients = 6;
/// An estimate with a larger standard error is none: the scale of a gyro, radians or rad/s of the others.
constexpr double kUnknown = 1;

struct Motion {
  std::unique_ptr<sim::Motion> motion;
  double duration_s = 0;
};

Motion motion_of(const std::string& name) {
  if (name.starts_with("path")) {
    auto path = std::make_unique<sim::PathMotion>(
        sim::load_path(NAVCAL_SOURCE_DIR "/fixtures/paths/" + name + ".csv"), kBegin_ns);
    const double duration_s = path->duration_s();
    return {std::move(path), duration_s};
  }
  const config::VehicleSettings vehicle;
  sim::MotionOptions options;
  options.start_ns = kBegin_ns;
  auto motion = std::make_unique<sim::SimulatedMotion>(
      vehicle, std::make_unique<sim::MissionHelm>(vehicle, config::load_mission(name)), options);
  const double duration_s = motion->duration_s();
  return {std::move(motion), duration_s};
}

/// Sums the yaw rates of gyro A.
class RateSum final : public pipeline::Sink {
 public:
  void on_sample(const instruments::Sample& sample) override {
    const auto* imu = std::get_if<instruments::ImuSample>(&sample.value);
    if (imu == nullptr) return;
    sum_rad_s_ += imu->rate_rad_s.value()[2];
    ++count_;
  }
  [[nodiscard]] double mean_rad_s() const { return sum_rad_s_ / static_cast<double>(count_); }

 private:
  double sum_rad_s_ = 0;
  std::uint64_t count_ = 0;
};

struct Replayed {
  calib::Report report;
  double mean_rate_rad_s = 0;
};

Replayed replay(const Motion& motion, const sim::Recording::Options& options, bool calibrate) {
  config::Settings settings;
  settings.ports = sim::recording_ports(options.instruments);
  settings.calibration.enabled = calibrate;
  settings.navigation.enabled = false;
  pipeline::Pipeline pipeline(settings);
  sim::Recording recording(options, *motion.motion);
  RateSum sink;
  std::vector<sim::LineRead> reads;
  const std::int64_t end_ns = kBegin_ns + std::llround(motion.duration_s * 1e9);
  for (std::int64_t t_ns = kBegin_ns; t_ns < end_ns;) {
    t_ns = std::min(t_ns + kSecond_ns, end_ns);
    reads.clear();
    recording.advance(t_ns, reads);
    for (const sim::LineRead& read : reads) {
      if (!read.sent) pipeline.bytes(static_cast<std::uint16_t>(read.of), read.time_ns, read.bytes, sink);
    }
  }
  if (!calibrate) return {{}, sink.mean_rad_s()};
  pipeline.finish_calibration(sink);
  return {pipeline.calibration_report(), sink.mean_rad_s()};
}

struct Tally {
  int runs = 0, known = 0, covered = 0;
  double square = 0, stated = 0, normalised = 0;
  void add(double error, double std) {
    ++runs;
    if (!(std < kUnknown)) return;
    ++known;
    covered += std::abs(error) <= 2 * std ? 1 : 0;
    square += error * error;
    stated += std * std;
    normalised += error * error / (std * std);
  }
  void add(const Tally& other) {
    runs += other.runs;
    known += other.known;
    covered += other.covered;
    normalised += other.normalised;
  }
};
using Tallies = std::array<Tally, kCoefficients>;

void add_run(const std::string& name, std::uint64_t seed, bool noise, Tallies& tallies) {
  sim::Recording::Options options;
  options.begin_ns = kBegin_ns;
  options.noise = noise;
  options.seed = seed;
  const Replayed run = replay(motion_of(name), options, true);
  // The same noise without the bias: their difference is the bias.
  options.turn_on_bias = false;
  const double bias_rad_s =
      noise ? run.mean_rate_rad_s - replay(motion_of(name), options, false).mean_rate_rad_s : 0;
  const auto add = [&](std::size_t i, calib::Calibrator calibrator, std::string_view quantity, double truth) {
    for (const auto& one : run.report.calibrators) {
      if (one.calibrator != calibrator) continue;
      if (const auto* found = one.quantity(quantity)) tallies[i].add(found->value - truth, found->std);
    }
  };
  add(0, calib::Calibrator::gyro, "scale", 1);
  add(1, calib::Calibrator::gyro, "bias_rad_s", -bias_rad_s);
  constexpr std::array<std::string_view, 4> kNames{"B_rad", "C_rad", "D_rad", "E_rad"};
  for (std::size_t i = 0; i < kNames.size(); ++i) add(2 + i, calib::Calibrator::compass, kNames[i], 0);
}

std::string row(const std::string& name, const Tallies& tallies) {
  constexpr std::array<double, kCoefficients> kUnits{100, kDegrees, kDegrees, kDegrees, kDegrees, kDegrees};
  std::string text = "| " + name + " |";
  for (std::size_t i = 0; i < kCoefficients; ++i) {
    const Tally& t = tallies[i];
    if (t.known == 0) {
      text += " unknown |";
      continue;
    }
    text += fmt::format(" {}/{}, {:.2g} of {:.2g} |", t.covered, t.known,
                        std::sqrt(t.square / t.known) * kUnits[i], std::sqrt(t.stated / t.known) * kUnits[i]);
  }
  return text;
}

}  // namespace

void print_missions(const TableOptions& options) {
  const int runs = std::max(1, options.runs / 100);
  std::puts(
      fmt::format("{} seeds each. Runs with the truth within two stated standard errors, root-mean-square error "
                  "and stated error. Scale in percent, bias in degrees/s, B..E in degrees.\n\n"
                  "| mission | scale | bias | B | C | D | E |\n|-|-|-|-|-|-|-|",
                  runs)
          .c_str());
  for (const bool noise : {true, false}) {
    Tally pooled;
    std::uint64_t seed = 2001;
    std::vector<std::string> names{"survey", "identification", "calibration_swing"};
    for (int i = 1; i <= 8; ++i) names.push_back("thesis" + std::to_string(i));
    for (int i = 1; i <= 8; ++i) names.push_back("path" + std::to_string(i));
    for (const std::string& name : names) {
      Tallies tallies{};
      for (int run = 0; run < (noise ? runs : 1); ++run) add_run(name, seed++, noise, tallies);
      if (noise) std::puts(row(name, tallies).c_str());
      for (const Tally& tally : tallies) pooled.add(tally);
    }
    std::puts(fmt::format("\n{}: covered {} of {} ({:.1f} %), errors {:.2f} of those stated; unknown {}.",
                          noise ? "With noise" : "Without noise", pooled.covered, pooled.known,
                          100.0 * pooled.covered / pooled.known, std::sqrt(pooled.normalised / pooled.known),
                          pooled.runs - pooled.known)
                  .c_str());
  }
}

}  // namespace navcal::bench
