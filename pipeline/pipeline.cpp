#include "pipeline/pipeline.h"

#include <limits>
#include <string>

#include "pipeline/calibration_stage.h"
#include "pipeline/navigation_stage.h"
#include "pipeline/port_stream.h"
#include "pipeline/sources.h"

namespace navcal::pipeline {

namespace {

/// Puts the calibration in force on samples that pass, lets the estimator of position see both, and the
/// calibrators learn from what came. Either stage may be absent.
class Stages final : public Sink {
 public:
  Stages(CalibrationStage* calibration, NavigationStage* navigation, Sources& sources,
         const std::vector<config::PortSettings>& ports, const UtcMapping& mapping, Sink& next)
      : calibration_(calibration),
        navigation_(navigation),
        sources_(sources),
        ports_(ports),
        mapping_(mapping),
        next_(next) {}
  void on_sample(const instruments::Sample& sample) override {
    take_source(sample);
    instruments::Sample corrected = sample;
    if (calibration_ != nullptr) calibration_->correct(corrected);
    next_.on_sample(corrected);
    if (navigation_ != nullptr) navigation_->take(sample, corrected, mapping_, next_);
    if (calibration_ != nullptr) calibration_->learn(sample, next_);
  }
  void on_frame(std::uint16_t port, const protocols::Frame& frame, std::int64_t arrival_ns) override {
    next_.on_frame(port, frame, arrival_ns);
  }
  void on_stream_event(const StreamEvent& event) override { next_.on_stream_event(event); }
  void on_mapping(const UtcMapping& mapping) override { next_.on_mapping(mapping); }

 private:
  void take_source(const instruments::Sample& sample) {
    const auto change = sources_.take(sample);
    if (calibration_ != nullptr) calibration_->use(sources_.learnt());
    if (!change) return;
    if (navigation_ != nullptr) navigation_->use(sources_.serving());
    const std::string role(name_of(change->role)), name = "source." + role;
    std::string message = "serves the " + role;
    if (change->before) {
      const std::string& before = ports_[*change->before].name;
      message += change->silent ? ", because " + before + " is silent" : " instead of " + before;
    }
    next_.on_stream_event(
        {change->port, sample.stamp.arrival_ns, change->silent ? "warning" : "info", name, message});
  }

  CalibrationStage* calibration_;
  NavigationStage* navigation_;
  Sources& sources_;
  const std::vector<config::PortSettings>& ports_;
  const UtcMapping& mapping_;
  Sink& next_;
};

}  // namespace

struct Pipeline::State {
  config::Settings settings;
  UtcMapping mapping;
  std::vector<std::unique_ptr<PortStream>> ports;
  std::unique_ptr<CalibrationStage> calibration;
  std::unique_ptr<NavigationStage> navigation;
  Sources sources;

  explicit State(const config::Settings& given) : settings(given), sources(settings) {}

  /// `use(sink)` with the sink to which the ports' samples go.
  template <class Use>
  void through_stages(Sink& sink, Use use) {
    if (!calibration && !navigation) return use(sink);
    Stages stages(calibration.get(), navigation.get(), sources, settings.ports, mapping, sink);
    use(stages);
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
    state_->ports.push_back(
        std::make_unique<PortStream>(static_cast<std::uint16_t>(i), state_->settings.ports[i], state_->mapping));
  }
  state_->calibration = CalibrationStage::make(state_->settings);
  state_->navigation = NavigationStage::make(state_->settings);
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

bool Pipeline::calibrates() const { return state_->calibration != nullptr; }

std::string Pipeline::order_calibration(CalibrationOrder order, calib::Calibrator calibrator, std::int64_t now_ns,
                                        Sink& sink) {
  if (!state_->calibration) return "the configuration has nothing to calibrate";
  advance(now_ns, sink);  // what is due by then comes before it, live as in replay
  return state_->calibration->order(order, calibrator, now_ns, sink);
}

calib::Report Pipeline::calibration_report() const {
  return state_->calibration ? state_->calibration->report() : calib::Report{};
}

CalibrationChange Pipeline::calibration_beginning(std::int64_t now_ns) {
  return state_->calibration ? state_->calibration->beginning(now_ns) : CalibrationChange{};
}

bool Pipeline::restore_calibration(std::string_view state) {
  return state_->calibration && state_->calibration->restore(state);
}

std::string Pipeline::replay_calibration(const CalibrationChange& change, Sink& sink) {
  using Cause = CalibrationChange::Cause;
  if (!state_->calibration || change.cause == Cause::automatic) return {};
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
  if (state_->calibration) state_->calibration->begin_run();
}

void Pipeline::finish_calibration(Sink& sink) {
  if (state_->calibration) state_->calibration->finish(sink);
}

void Pipeline::begin_navigation_run() {
  state_->sources.begin_run();
  if (!state_->navigation) return;
  state_->navigation->begin_run();
  state_->navigation->use(state_->sources.serving());
}

PortStatistics Pipeline::statistics(std::uint16_t port) const { return state_->ports.at(port)->statistics(); }
const config::Settings& Pipeline::settings() const { return state_->settings; }

}  // namespace navcal::pipeline
