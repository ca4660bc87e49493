// SPDX-License-Identifier: Apache-2.0
#include "pipeline/pipeline.h"

#include <navcal/pipeline.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "api/guard.h"
#include "api/sample_of.h"
#include "config/load.h"

namespace navcal::api {
namespace {

/// The samples of one call.
class SampleList final : public pipeline::Sink {
 public:
  void on_sample(const instruments::Sample& sample) override {
    if (auto made = sample_of(sample)) samples.push_back(std::move(*made));
  }
  void on_navigation(const pipeline::NavigationSample& sample) override { samples.push_back(sample_of(sample)); }
  void on_battery(const pipeline::BatterySample& sample) override { samples.push_back(sample_of(sample)); }

  std::vector<Sample> samples;
};

pipeline::UtcMapping::Source source_of(UtcSource source) {
  switch (source) {
    case UtcSource::file: return pipeline::UtcMapping::Source::file;
    case UtcSource::system: return pipeline::UtcMapping::Source::system;
    case UtcSource::system_synchronised: return pipeline::UtcMapping::Source::system_synchronised;
  }
  throw Error(ErrorKind::bad_argument, "mapping: there is no such source of UTC");
}

}  // namespace

struct Pipeline::State {
  explicit State(const config::Settings& settings) : ports(ports_of(settings)), pipeline(settings) {}

  void expect_port(std::size_t port) const {
    if (port < ports.size()) return;
    throw Error(ErrorKind::bad_argument, "port " + std::to_string(port) + ": the configuration has " +
                                             std::to_string(ports.size()) + " ports, counted from 0");
  }
  void expect_time(std::int64_t time_ns) {
    if (time_ns < newest_ns) {
      throw Error(ErrorKind::bad_argument, "time " + std::to_string(time_ns) +
                                               " ns: before that of an earlier call, " +
                                               std::to_string(newest_ns) + " ns");
    }
    newest_ns = time_ns;
  }

  std::vector<Port> ports;
  pipeline::Pipeline pipeline;
  std::int64_t newest_ns = std::numeric_limits<std::int64_t>::min();
};

Pipeline::Pipeline(std::unique_ptr<State> state) : state_(std::move(state)) {}
Pipeline::~Pipeline() = default;
Pipeline::Pipeline(Pipeline&& other) noexcept = default;
Pipeline& Pipeline::operator=(Pipeline&& other) noexcept = default;

Pipeline Pipeline::from_file(const std::filesystem::path& config) {
  return guarded([&] { return Pipeline(std::make_unique<State>(config::load(config))); });
}

Pipeline Pipeline::from_text(std::string_view toml, std::string_view name) {
  return guarded([&] { return Pipeline(std::make_unique<State>(config::parse(toml, name))); });
}

const std::vector<Port>& Pipeline::ports() const { return state_->ports; }

std::size_t Pipeline::port(std::string_view name) const {
  const auto found = std::ranges::find(state_->ports, name, &Port::name);
  if (found == state_->ports.end()) {
    throw Error(ErrorKind::bad_argument, "port " + std::string(name) + ": the configuration has no such port");
  }
  return static_cast<std::size_t>(found - state_->ports.begin());
}

std::vector<Sample> Pipeline::push(std::size_t port, std::int64_t arrival_ns,
                                   std::span<const std::uint8_t> bytes) {
  return guarded([&] {
    state_->expect_port(port);
    state_->expect_time(arrival_ns);
    SampleList made;
    state_->pipeline.bytes(static_cast<std::uint16_t>(port), arrival_ns, bytes, made);
    return std::move(made.samples);
  });
}

std::vector<Sample> Pipeline::advance(std::int64_t now_ns) {
  return guarded([&] {
    state_->expect_time(now_ns);
    SampleList made;
    state_->pipeline.advance(now_ns, made);
    return std::move(made.samples);
  });
}

std::vector<Sample> Pipeline::set_mapping(const UtcMapping& mapping) {
  return guarded([&] {
    SampleList made;
    state_->pipeline.set_mapping({source_of(mapping.source), mapping.offset_ns, mapping.bound_ns, mapping.at_ns},
                                 made);
    return std::move(made.samples);
  });
}

PortCounters Pipeline::counters(std::size_t port) const {
  return guarded([&] {
    state_->expect_port(port);
    const auto statistics = state_->pipeline.statistics(static_cast<std::uint16_t>(port));
    return PortCounters{statistics.bytes.framed_bytes, statistics.bytes.skipped_bytes, statistics.held_bytes,
                        statistics.samples};
  });
}

}  // namespace navcal::api
