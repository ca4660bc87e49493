// SPDX-License-Identifier: Apache-2.0
// Pressure gauges on the simulated vehicle, with their start-up dialogues, to their samples.
#include "sim/instruments/pressure_gauges.h"

#include <gtest/gtest.h>

#include "config/load.h"
#include "instruments/start_up.h"
#include "pipeline/pipeline.h"
#include "tests/sim/drive.h"

namespace navcal::analysis {
namespace {

using instruments::DepthSample;
using protocols::Protocol;
using sim::testing::kSecond_ns;
using sim::testing::kStart_ns;

struct Submerged : sim::testing::Still {
  Submerged() { state.position_m = {0, 0, 5}; }
};

/// The gauge, its dialogue and a pipeline.
std::vector<DepthSample> gauge_samples(Protocol protocol, sim::Device& gauge, int seconds) {
  const auto settings = config::default_port("gauge", protocol, config::default_baud(protocol));
  const auto start_up = instruments::make_start_up(settings);
  struct Frames : pipeline::Sink {
    void on_sample(const instruments::Sample& sample) override { samples.push_back(sample); }
    void on_frame(std::uint16_t, const protocols::Frame& frame, std::int64_t now_ns) override {
      dialogue->on_frame(frame, now_ns);
    }
    instruments::StartUp* dialogue = nullptr;
    std::vector<instruments::Sample> samples;
  } sink;
  sink.dialogue = start_up.get();
  config::Settings all;
  all.ports.push_back(settings);
  pipeline::Pipeline stream(all);
  gauge.power_on(kStart_ns);
  start_up->begin(kStart_ns);
  for (std::int64_t now_ns = kStart_ns; now_ns < kStart_ns + seconds * kSecond_ns; now_ns += kSecond_ns / 1000) {
    std::vector<sim::Emission> emissions;
    gauge.advance(now_ns, emissions);
    for (const auto& emission : emissions) stream.bytes(0, now_ns + 1, emission.bytes, sink);
    while (const auto request = start_up->next(now_ns)) gauge.on_bytes(now_ns, *request);
  }
  EXPECT_EQ(stream.statistics(0).out_of_range, 0U);
  std::vector<DepthSample> samples;
  for (const auto& sample : sink.samples) samples.push_back(std::get<DepthSample>(sample.value));
  return samples;
}

TEST(PressureGauges, GivePascalWhateverTheirUnit) {
  const Submerged motion;
  for (int unit = 1; unit <= 8; ++unit) {
    sim::ParoscientificEmulator::Options options;
    options.unit = unit;
    sim::ParoscientificEmulator gauge(options, motion);
    const auto samples = gauge_samples(Protocol::paroscientific, gauge, 10);
    EXPECT_GE(samples.size(), 13U);
    for (const DepthSample& sample : samples)
      EXPECT_NEAR(sample.pressure_Pa.value(), sim::absolute_pressure_Pa(motion.state), 120) << unit;
  }
}

TEST(PressureGauges, KellerIsPolledWithAndWithoutEchoes) {
  const Submerged motion;
  for (const bool echoes : {false, true}) {
    sim::KellerEmulator::Options options;
    options.echoes = echoes;
    sim::KellerEmulator gauge(options, motion);
    const auto samples = gauge_samples(Protocol::keller, gauge, 10);
    EXPECT_NEAR(static_cast<double>(samples.size()), 100, 2);
    for (const DepthSample& sample : samples)
      EXPECT_NEAR(sample.pressure_Pa.value(), sim::absolute_pressure_Pa(motion.state), 120);
  }
}

}  // namespace
}  // namespace navcal::analysis
