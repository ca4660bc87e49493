// SPDX-License-Identifier: Apache-2.0
#include "bench/dvl_navigation/reckoning_run.h"

#include <algorithm>
#include <cmath>

#include "base/durations.h"
#include "base/local_plane.h"
#include "base/reference_instruments.h"
#include "config/mission_file.h"
#include "pipeline/port_stream.h"
#include "pipeline/stages.h"
#include "sim/effects/effect_table.h"
#include "sim/recording.h"
#include "sim/vehicle/mission_helm.h"

namespace navcal::bench {
namespace {

constexpr std::int64_t kBegin_ns = 1'767'225'600'000'000'000;
/// A share of a shorter way says little.
constexpr double kLeastWay_m = 50;
constexpr std::uint16_t kDopplerPort = 4;

double mission_time_s(std::int64_t time_ns) { return base::seconds(time_ns - kBegin_ns); }

Eigen::Vector2d true_place_m(const sim::State& state) { return {state.position_m[0], state.position_m[1]}; }

/// Compares each estimate with the truth.
class ErrorWatch final : public pipeline::Sink {
 public:
  explicit ErrorWatch(const sim::Motion& motion)
      : motion_(motion), plane_(sim::Origin().latitude_deg / base::kDegreesPerRadian,
                                sim::Origin().longitude_deg / base::kDegreesPerRadian) {}

  void on_sample(const instruments::Sample&) override {}
  void on_navigation(const pipeline::NavigationSample& sample) override {
    const auto& estimate = sample.estimate;
    const Eigen::Vector2d truth_m = true_place_m(motion_.at(estimate.time_ns));
    if (before_m_) way_m_ += (truth_m - *before_m_).norm();
    before_m_ = truth_m;
    if (!sample.latitude_rad || sample.source != pipeline::PositionSource::reckoned) {
      way_m_ = 0;
      return;
    }
    const auto [north_m, east_m] = plane_.position_m(*sample.latitude_rad, *sample.longitude_rad);
    const Eigen::Vector2d error_m = Eigen::Vector2d(north_m, east_m) - truth_m;
    outcome_.way_m = way_m_;
    outcome_.error_m = error_m.norm();
    outcome_.normalised = error_m.cwiseQuotient(estimate.position_std_m).squaredNorm() / 2;
    if (way_m_ < kLeastWay_m) return;
    squares_ += std::pow(100 * outcome_.error_m / way_m_, 2);
    ++count_;
  }
  [[nodiscard]] ReckoningRun::Outcome outcome() const {
    ReckoningRun::Outcome outcome = outcome_;
    outcome.per_100_m = std::sqrt(squares_ / std::max(count_, 1));
    return outcome;
  }

 private:
  const sim::Motion& motion_;
  base::LocalPlane plane_;
  std::optional<Eigen::Vector2d> before_m_;
  double way_m_ = 0, squares_ = 0;
  int count_ = 0;
  ReckoningRun::Outcome outcome_;
};

config::Settings settings_of(const ReckoningRun::Errors& errors) {
  config::Settings settings;
  settings.ports = sim::recording_ports({});
  auto& doppler = settings.ports.emplace_back();
  doppler.name = "dvl";
  doppler.protocol = protocols::Protocol::pd0;
  settings.calibration.enabled = false;
  // The simulated field is one field everywhere, not that of the model at this place and date.
  settings.environment.model = false;
  settings.environment.declination_rad = std::atan2(base::reference::kField_uT[1], base::reference::kField_uT[0]);
  settings.navigation.heading_error_rad = errors.heading_error_rad;
  return settings;
}

instruments::Sample sample_of(const instruments::DvlSample& dvl, std::int64_t time_ns) {
  instruments::Sample sample;
  sample.port = kDopplerPort;
  sample.stamp.validity_ns = sample.stamp.validity_utc_ns = time_ns;
  sample.stamp.arrival_ns = sample.stamp.arrival_utc_ns = time_ns + DopplerLog::kLatency_ns;
  sample.value = dvl;
  return sample;
}

}  // namespace

ReckoningRun::ReckoningRun(const std::string& mission, const Errors& errors, std::uint64_t seed)
    : errors_(errors), seed_(seed), effects_(std::make_unique<sim::EffectSet>(kBegin_ns)) {
  sim::Noise noise(seed);
  const auto add = [&](const char* name, const std::vector<double>& parameters) {
    effects_->add(sim::make_effect(name)).set_parameters(parameters);
  };
  add("water_current", {noise.normal(errors.current_m_s), noise.normal(errors.current_m_s)});
  // The speed goes with the root of the thrust.
  add("thrust_scale", {std::pow(1 + noise.normal(errors.speed_error), 2) - 1});
  add("compass_misalignment", {0, 0, noise.normal(errors.heading_error_rad) * base::kDegreesPerRadian});
  const config::VehicleSettings vehicle;
  sim::MotionOptions motion_options;
  motion_options.start_ns = kBegin_ns;
  motion_options.influencer = effects_.get();
  motion_ = std::make_unique<sim::SimulatedMotion>(
      vehicle, std::make_unique<sim::MissionHelm>(vehicle, config::load_mission(mission)), motion_options);
  sim::Recording::Options options;
  options.begin_ns = kBegin_ns;
  options.seed = seed;
  options.effects = effects_.get();
  options.sky_always_seen = true;
  sim::Recording recording(options, *motion_);
  for (double t_s = 1; t_s <= kDuration_s; ++t_s) recording.advance(kBegin_ns + std::llround(t_s * 1e9), reads_);
}

ReckoningRun::Outcome ReckoningRun::reckon(const std::optional<DopplerLogOptions>& dvl) const {
  const config::Settings settings = settings_of(errors_);
  const pipeline::StandardErrors errors(settings);
  pipeline::UtcMapping mapping;
  pipeline::Stages stages(settings);
  std::vector<std::unique_ptr<pipeline::PortStream>> ports;
  for (std::uint16_t port = 0; port < kDopplerPort; ++port)
    ports.push_back(std::make_unique<pipeline::PortStream>(port, settings.ports[port], errors, mapping));
  ErrorWatch watch(*motion_);
  pipeline::StagesSink sink(stages, mapping, watch);
  DopplerLog log(dvl.value_or(DopplerLogOptions{}), seed_ + 1);
  std::int64_t ping_ns = kBegin_ns;
  for (const sim::LineRead& read : reads_) {
    for (; dvl && ping_ns + DopplerLog::kLatency_ns <= read.time_ns; ping_ns += DopplerLog::kPeriod_ns)
      stages.take(sample_of(log.measure(motion_->at(ping_ns), mission_time_s(ping_ns)), ping_ns), mapping, watch);
    if (read.sent || (read.of == sim::Instrument::gps && mission_time_s(read.time_ns) > kFixes_s)) continue;
    ports.at(static_cast<std::size_t>(read.of))->bytes(read.time_ns, read.bytes, sink);
  }
  return watch.outcome();
}

}  // namespace navcal::bench
