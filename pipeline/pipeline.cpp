// SPDX-License-Identifier: Apache-2.0
#include "pipeline/pipeline.h"

#include <fmt/format.h>

#include <limits>
#include <string>

#include "pipeline/calibration_stage.h"
#include "pipeline/port_stream.h"
#include "pipeline/stages.h"

namespace navcal::pipeline {

void UnusedFrames::add(protocols::FrameId kind) {
  ++total_;
  for (auto& [known, frames] : kinds_) {
    if (frames > 0 && known != kind) continue;
    known = kind;
    ++frames;
    return;
  }
}

std::string UnusedFrames::words() const {
  std::string out;
  std::uint64_t others = total_;
  for (const auto& [kind, frames] : kinds_) {
    if (frames > 0) out += fmt::format("{}{} {}", out.empty() ? "" : ", ", kind.view(), frames);
    others -= frames;
  }
  return others > 0 ? out + fmt::format(", others {}", others) : out;
}

struct Pipeline::State {
  config::Settings settings;
  StandardErrors errors;
  UtcMapping mapping;
  std::vector<std::unique_ptr<PortStream>> ports;
  Stages stages;

  explicit State(const config::Settings& given) : settings(given), errors(settings), stages(settings) {}

  /// `use(sink)` with the sink to which the ports' samples go.
  template <class Use>
  void through_stages(Sink& sink, Use use) {
    if (stages.are_none()) return use(sink);
    StagesSink through(stages, mapping, sink);
    use(through);
  }

  /// The port whose incomplete frame is to be given up first; its time in `deadline_ns`.
  PortStream* first_due(std::int64_t& deadline_ns) const {
    PortStream* due = nullptr;
    deadline_ns = std::numeric_limits<std::int64_t>::max();
    for (const auto& port : ports) {
      if (const std::int64_t deadline = port->deadline_ns(); deadline < deadline_ns) {
        deadline_ns = deadline;
        due = port.get();
      }
    }
    return due;
  }
};

Pipeline::Pipeline(const config::Settings& settings) : state_(std::make_unique<State>(settings)) {
  for (std::size_t i = 0; i < settings.ports.size(); ++i) {
    state_->ports.push_back(std::make_unique<PortStream>(static_cast<std::uint16_t>(i), state_->settings.ports[i],
                                                         state_->errors, state_->mapping));
  }
}

Pipeline::~Pipeline() = default;

void Pipeline::bytes(std::uint16_t port, std::int64_t arrival_ns, protocols::Bytes bytes, Sink& sink) {
  advance(arrival_ns, sink);
  state_->through_stages(sink, [&](Sink& to) { state_->ports.at(port)->bytes(arrival_ns, bytes, to); });
}

// In the order of the deadlines, not of the ports: then it makes no difference whether a timer called for each of
// them (live) or all are found due at the next read (replay).
void Pipeline::advance(std::int64_t now_ns, Sink& sink) {
  std::int64_t deadline_ns = 0;
  for (PortStream* due = state_->first_due(deadline_ns); due != nullptr && deadline_ns <= now_ns;
       due = state_->first_due(deadline_ns)) {
    state_->through_stages(sink, [&](Sink& to) { due->silence(to); });
  }
}

std::int64_t Pipeline::next_deadline_ns() const {
  std::int64_t deadline_ns = 0;
  state_->first_due(deadline_ns);
  return deadline_ns;
}

void Pipeline::set_mapping(const UtcMapping& mapping, Sink& sink) {
  state_->mapping = mapping;
  sink.on_mapping(mapping);
}

const UtcMapping& Pipeline::mapping() const { return state_->mapping; }

bool Pipeline::calibrates() const { return state_->stages.calibration() != nullptr; }

std::string Pipeline::order_calibration(CalibrationOrder order, calib::Calibrator calibrator, std::int64_t now_ns,
                                        Sink& sink) {
  if (!state_->stages.calibration()) return "the configuration has nothing to calibrate";
  advance(now_ns, sink);  // what is due by then comes before it, live as in replay
  return state_->stages.calibration()->order(order, calibrator, now_ns, sink);
}

calib::Report Pipeline::calibration_report() const {
  return state_->stages.calibration() ? state_->stages.calibration()->report() : calib::Report{};
}

CalibrationChange Pipeline::calibration_beginning(std::int64_t now_ns) {
  return state_->stages.calibration() ? state_->stages.calibration()->beginning(now_ns) : CalibrationChange{};
}

bool Pipeline::restore_calibration(std::string_view state) { return state_->stages.restore_calibration(state); }

std::string Pipeline::replay_calibration(const CalibrationChange& change, Sink& sink) {
  using Cause = CalibrationChange::Cause;
  if (!state_->stages.calibration() || change.cause == Cause::automatic) return {};
  if (change.cause == Cause::begin) {
    advance(change.time_ns, sink);
    const bool restored = restore_calibration(change.state);
    return restored ? "" : "the state of its calibrators is of another version: they begin anew";
  }
  const auto order = change.cause == Cause::accept      ? CalibrationOrder::accept
                     : change.cause == Cause::force     ? CalibrationOrder::force
                     : change.cause == Cause::roll_back ? CalibrationOrder::roll_back
                                                        : CalibrationOrder::start;
  const auto why_not = order_calibration(order, change.calibrator.value(), change.time_ns, sink);
  return why_not.empty() ? "" : "a recorded change of the calibration cannot be made again: " + why_not;
}

void Pipeline::begin_calibration_run() {
  if (state_->stages.calibration()) state_->stages.calibration()->begin_run();
}

void Pipeline::finish_calibration(Sink& sink) {
  if (state_->stages.calibration()) state_->stages.calibration()->finish(sink);
}

std::optional<NavigationSample> Pipeline::navigation() const { return state_->stages.navigation(state_->mapping); }

void Pipeline::begin_navigation_run() { state_->stages.begin_navigation_run(); }

void Pipeline::set_battery(const BatteryCharge& charge) {
  if (state_->stages.battery()) state_->stages.battery()->set(charge);
}

std::optional<BatterySample> Pipeline::battery() const {
  return state_->stages.battery() ? state_->stages.battery()->newest() : std::nullopt;
}

RolePorts Pipeline::sources() const { return state_->stages.sources().delivering(); }
const EarthField& Pipeline::earth_field() const { return state_->stages.earth_field(); }

PortStatistics Pipeline::statistics(std::uint16_t port) const { return state_->ports.at(port)->statistics(); }
const config::Settings& Pipeline::settings() const { return state_->settings; }

}  // namespace navcal::pipeline
