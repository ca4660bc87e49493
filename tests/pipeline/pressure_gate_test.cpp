// SPDX-License-Identifier: Apache-2.0
// Gauges of pressure on a dive: what they measure relative to air is no absolute pressure, at the surface and
// below.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/durations.h"
#include "config/load.h"
#include "pipeline/pipeline.h"
#include "protocols/keller.h"

namespace navcal::pipeline {
namespace {

struct GaugeOutput : Sink {
  void on_sample(const instruments::Sample& sample) override {
    pressures_Pa.push_back(std::get<instruments::DepthSample>(sample.value).pressure_Pa.value());
  }
  void on_navigation(const NavigationSample& sample) override { depth_m = sample.estimate.depth_m; }
  std::vector<double> pressures_Pa;
  std::optional<double> depth_m;
};

config::Settings with_gauge(protocols::Protocol protocol) {
  config::Settings settings;
  settings.ports.push_back(config::default_port("gauge", protocol, config::default_baud(protocol)));
  return settings;
}

/// A dive from the surface to 12 m, ten readings a second: `reading(depth_m, k)` are the bytes of reading k.
template <class Reading>
GaugeOutput dive(Pipeline& pipeline, Reading reading) {
  GaugeOutput seen;
  for (int k = 0; k < 240; ++k) {
    const auto bytes = reading(0.05 * k, k);
    pipeline.bytes(0, (10 + k) * 100 * base::kMillisecond_ns,
                   {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}, seen);
  }
  return seen;
}

TEST(PressureOnADive, AGaugeRelativeToAirIsNotBelievedBelowEither) {
  Pipeline keller(with_gauge(protocols::Protocol::keller));
  const auto seen = dive(keller, [](double depth_m, int) {
    return protocols::keller::encode(protocols::keller::Reading{250, static_cast<float>(0.1 * depth_m), 0});
  });
  EXPECT_TRUE(seen.pressures_Pa.empty());
  EXPECT_FALSE(seen.depth_m.has_value());
  EXPECT_EQ(keller.statistics(0).out_of_range, 240U);

  Pipeline injected(with_gauge(protocols::Protocol::samples));
  const auto lines = dive(injected, [](double depth_m, int) {
    return fmt::format("{{\"class\":\"DEPTH\",\"pressure_Pa\":{:.1f}}}\n", 1e4 * depth_m);
  });
  EXPECT_TRUE(lines.pressures_Pa.empty());
  EXPECT_EQ(injected.statistics(0).out_of_range, 240U);
}

TEST(PressureOnADive, SingleWrongReadingsOfAnAbsoluteGaugeCostThemselvesOnly) {
  Pipeline pipeline(with_gauge(protocols::Protocol::keller));
  const auto seen = dive(pipeline, [](double depth_m, int k) {
    const bool is_wrong = k % 10 < 2;
    return protocols::keller::encode(
        protocols::keller::Reading{250, static_cast<float>(is_wrong ? 0 : 1.01325 + 0.1 * depth_m), 0});
  });
  EXPECT_EQ(seen.pressures_Pa.size(), 192U);
  EXPECT_EQ(pipeline.statistics(0).out_of_range, 48U);
}

}  // namespace
}  // namespace navcal::pipeline
