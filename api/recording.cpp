// SPDX-License-Identifier: Apache-2.0
#include <navcal/recording.h>

#include <deque>
#include <utility>

#include "analysis/replay_run.h"
#include "api/guard.h"
#include "api/sample_of.h"
#include "config/load.h"

namespace navcal::api {
namespace {

/// Keeps the samples that one entry of a recording made.
class SampleQueue final : public analysis::ReplaySink {
 public:
  void on_sample(const instruments::Sample& sample) override {
    if (auto made = sample_of(sample)) waiting_.push_back(std::move(*made));
  }
  void on_navigation(const pipeline::NavigationSample& sample) override { waiting_.push_back(sample_of(sample)); }
  void on_battery(const pipeline::BatterySample& sample) override { waiting_.push_back(sample_of(sample)); }

  std::optional<Sample> take() {
    if (waiting_.empty()) return std::nullopt;
    Sample first = std::move(waiting_.front());
    waiting_.pop_front();
    return first;
  }

 private:
  std::deque<Sample> waiting_;
};

}  // namespace

struct Recording::State {
  State(std::filesystem::path opened, const config::Settings& in_use)
      : file(std::move(opened)), settings(in_use), ports(ports_of(in_use)), run(in_use) {}

  std::filesystem::path file;
  config::Settings settings;
  std::vector<Port> ports;
  analysis::ReplayRun run;
  SampleQueue queue;
};

Recording::Recording(const std::filesystem::path& file, const std::filesystem::path& config) {
  guarded([&] {
    auto recording = record::Recording::open(file);
    state_ = std::make_unique<State>(file, config.empty() ? recording->settings() : config::load(config));
    state_->run.open(std::move(recording), file.string());
  });
}

Recording::~Recording() = default;
Recording::Recording(Recording&& other) noexcept = default;
Recording& Recording::operator=(Recording&& other) noexcept = default;

const std::vector<Port>& Recording::ports() const { return state_->ports; }

std::string Recording::configuration() const {
  return guarded([&] {
    config::Settings settings = state_->settings;
    for (auto& port : settings.ports) {
      const bool has_place =
          !port.path.empty() || !port.udev_name.empty() || !port.usb_serial.empty() || !port.address.empty();
      if (!has_place) port.path = std::filesystem::absolute(state_->file).string() + ":" + port.name;
    }
    return config::to_toml(settings);
  });
}

std::optional<Sample> Recording::next() {
  return guarded([&] {
    auto sample = state_->queue.take();
    while (!sample && state_->run.step(state_->queue)) sample = state_->queue.take();
    return sample ? std::move(sample) : state_->queue.take();
  });
}

double Recording::progress() const { return state_->run.progress(); }

const std::vector<std::string>& Recording::remarks() const { return state_->run.remarks(); }

}  // namespace navcal::api
