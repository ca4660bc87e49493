#include "pipeline/pipeline.h"

#include <limits>

#include "pipeline/port_stream.h"

namespace navcal::pipeline {

struct Pipeline::State {
  config::Settings settings;
  UtcMapping mapping;
  std::vector<std::unique_ptr<PortStream>> ports;

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

Pipeline::Pipeline(const config::Settings& settings) : state_(std::make_unique<State>()) {
  state_->settings = settings;
  for (std::size_t i = 0; i < settings.ports.size(); ++i) {
    state_->ports.push_back(
        std::make_unique<PortStream>(static_cast<std::uint16_t>(i), state_->settings.ports[i], state_->mapping));
  }
}

Pipeline::~Pipeline() = default;

void Pipeline::bytes(std::uint16_t port, std::int64_t arrival_ns, protocols::Bytes bytes, Sink& sink) {
  advance(arrival_ns, sink);
  state_->ports.at(port)->bytes(arrival_ns, bytes, sink);
}

// In the order of the deadlines, not of the ports: then it makes no difference whether a timer called for each of
// them (live) or all are found due at the next read (replay).
void Pipeline::advance(std::int64_t now_ns, Sink& sink) {
  std::int64_t deadline_ns = 0;
  for (PortStream* due = state_->first_due(deadline_ns); due != nullptr && deadline_ns <= now_ns;
       due = state_->first_due(deadline_ns)) {
    due->silence(sink);
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
PortStatistics Pipeline::statistics(std::uint16_t port) const { return state_->ports.at(port)->statistics(); }
const config::Settings& Pipeline::settings() const { return state_->settings; }

}  // namespace navcal::pipeline
