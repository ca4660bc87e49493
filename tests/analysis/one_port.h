// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "config/load.h"
#include "pipeline/pipeline.h"
#include "sim/instruments/device.h"
#include "tests/sim/drive.h"

namespace navcal::analysis {

/// One port without anything else.
class OnePort : private pipeline::Sink {
 public:
  explicit OnePort(protocols::Protocol protocol) : pipeline_(settings_of(protocol)) {}

  void bytes(std::int64_t now_ns, protocols::Bytes bytes) { pipeline_.bytes(0, now_ns, bytes, *this); }
  void run(sim::Device& device, int seconds) {
    device.power_on(sim::testing::kStart_ns);
    for (const sim::Emission& emission :
         sim::testing::run_to(device, sim::testing::kStart_ns + seconds * sim::testing::kSecond_ns)) {
      const auto wire_ns =
          static_cast<std::int64_t>(emission.bytes.size()) * 10 * sim::testing::kSecond_ns / device.baud();
      bytes(emission.start_ns + wire_ns, emission.bytes);
    }
  }
  [[nodiscard]] pipeline::PortStatistics statistics() const { return pipeline_.statistics(0); }
  template <class T>
  [[nodiscard]] std::vector<T> all() const {
    std::vector<T> found;
    for (const auto& sample : samples) {
      if (const auto* value = std::get_if<T>(&sample.value)) found.push_back(*value);
    }
    return found;
  }

  std::vector<instruments::Sample> samples;

 private:
  static config::Settings settings_of(protocols::Protocol protocol) {
    config::Settings settings;
    settings.ports.push_back(config::default_port("log", protocol, config::default_baud(protocol)));
    return settings;
  }
  void on_sample(const instruments::Sample& sample) override { samples.push_back(sample); }

  pipeline::Pipeline pipeline_;
};

}  // namespace navcal::analysis
