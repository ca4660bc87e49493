// SPDX-License-Identifier: Apache-2.0
#include "tests/gap/simulated_mission.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <utility>

#include "base/angles.h"
#include "config/mission_file.h"
#include "record/capture/capture_writer.h"
#include "record/whole_file.h"
#include "sim/effects/document.h"
#include "sim/layout/layout_of.h"
#include "sim/noise.h"
#include "sim/recording.h"
#include "sim/vehicle/mission_helm.h"
#include "sim/vehicle/simulated_motion.h"
#include "tests/support/temporary_folder.h"

namespace navcal::gap::test {
namespace {

constexpr std::int64_t kBegin_ns = 1'767'225'600'000'000'000;

/// A helm whose orders move towards those of another one, in steps of 50 ms and by 10 degrees each (200 deg/s).
class ShapedHelm final : public sim::Helm {
 public:
  ShapedHelm(const config::VehicleSettings& vehicle, std::unique_ptr<sim::Helm> helm, std::uint64_t seed)
      : layout_(sim::layout_of(vehicle)), helm_(std::move(helm)), dice_(seed),
        told_(helm_->positions_at_start().surfaces_rad), wanted_(told_) {}

  [[nodiscard]] sim::Body start() const override { return helm_->start(); }
  [[nodiscard]] sim::ActuatorValues positions_at_start() const override { return helm_->positions_at_start(); }
  [[nodiscard]] Positions positions() const override { return Positions::written; }
  [[nodiscard]] bool finished() const override { return helm_->finished(); }
  void next(double time_s, double step_s, const sim::Body& body, sim::Actuators& actuators) override {
    helm_->next(time_s, step_s, body, actuators);
    if (actuators.is_new_order) wanted_ = actuators.commands.surfaces_rad;
    actuators.is_new_order = false;
    // The part of the step before the order acts belongs to the order before.
    double late_s = 0;
    const sim::ActuatorNumbers before = told_;
    if (until_order_s_ < step_s / 2) {
      until_order_s_ += 0.05;
      if (!(told_ == wanted_)) {
        constexpr double kMost_rad = 10 * base::kRadiansPerDegree;
        for (std::size_t i = 0; i < told_.size(); ++i)
          told_[i] = std::clamp(wanted_[i], told_[i] - kMost_rad, told_[i] + kMost_rad);
        actuators.is_new_order = true;
        late_s = dice_.uniform(0, 0.8 * step_s);
      }
    }
    until_order_s_ -= step_s;
    for (const auto& [fins_rad, seconds] : {std::pair(before, late_s), std::pair(told_, step_s - late_s)}) {
      actuators.commands.surfaces_rad = fins_rad;
      actuators.positions = sim::follow(layout_, actuators.positions, actuators.commands, seconds);
    }
  }

 private:
  config::Layout layout_;
  std::unique_ptr<sim::Helm> helm_;
  sim::Noise dice_;
  sim::ActuatorNumbers told_, wanted_;
  double until_order_s_ = 0;
};

std::unique_ptr<sim::Helm> mission_helm(std::string_view mission) {
  return std::make_unique<sim::MissionHelm>(config::VehicleSettings{}, config::load_mission(std::string(mission)));
}

void write_steered(const std::filesystem::path& file, std::unique_ptr<sim::Helm> helm, std::string_view effects,
                   double seconds, std::uint64_t seed, const devices::InstrumentModel& model) {
  sim::EffectSet set(kBegin_ns);
  std::vector<config::Problem> problems;
  sim::add_effects(effects, set, problems);
  if (!problems.empty()) throw std::invalid_argument("effects of a test");
  set.reseed(seed);
  const sim::SimulatedMotion motion(config::VehicleSettings{}, std::move(helm), {kBegin_ns, &set, 20});
  sim::Recording::Options options;
  options.begin_ns = kBegin_ns;
  options.seed = seed;
  options.effects = &set;
  options.instruments = model;
  sim::Recording instruments(options, motion);
  record::CaptureWriter writer(sim::recording_ports(options.instruments));
  std::string text;
  writer.begin(text);
  record::CaptureWriter::comment(text,
                                 "event simulated field of the Earth: north 19.000, east 0.600, down 44.000 uT");
  std::vector<sim::LineRead> reads;
  // In short steps: the motion remembers its last seconds only.
  for (double until_s = 0; until_s < seconds; until_s += 1) {
    instruments.advance(kBegin_ns + std::llround(std::min(until_s + 1, seconds) * 1e9), reads);
  }
  for (const sim::LineRead& read : reads) {
    const auto direction = read.sent ? record::Direction::sent : record::Direction::received;
    writer.bytes(text, static_cast<std::uint16_t>(read.of), direction, read.time_ns, read.bytes);
  }
  record::WholeFile whole(file);
  whole.write(text);
  whole.commit();
}

}  // namespace

void write_mission(const std::filesystem::path& file, std::string_view mission, std::string_view effects,
                   double seconds, std::uint64_t seed, const devices::InstrumentModel& model) {
  write_steered(file, mission_helm(mission), effects, seconds, seed, model);
}

void write_shaped_mission(const std::filesystem::path& file, std::string_view mission, std::string_view effects,
                          double seconds, std::uint64_t seed) {
  auto helm = std::make_unique<ShapedHelm>(config::VehicleSettings{}, mission_helm(mission), seed);
  write_steered(file, std::move(helm), effects, seconds, seed, {});
}

Mission simulated_mission(std::string_view mission, std::string_view effects, double seconds, std::uint64_t seed,
                          const devices::InstrumentModel& instruments) {
  const navcal::test::TemporaryFolder folder;
  write_mission(folder / "mission.cap", mission, effects, seconds, seed, instruments);
  return load_mission(folder / "mission.cap", [](double) {});
}

}  // namespace navcal::gap::test
