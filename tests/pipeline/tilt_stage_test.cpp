// SPDX-License-Identifier: Apache-2.0
#include "pipeline/tilt_stage.h"

#include <gtest/gtest.h>

#include <cmath>

namespace navcal::pipeline {
namespace {

using protocols::Protocol;
constexpr std::int64_t kStep_ns = 50'000'000;
enum TiltPort : std::uint16_t { nmea_port, imu_port };

config::Settings compass_and_card() {
  config::Settings settings;
  settings.ports.emplace_back().protocol = Protocol::nmea;
  settings.ports.emplace_back().protocol = Protocol::imu_card;
  return settings;
}

instruments::Sample sample_of(std::uint16_t port, std::int64_t time_ns,
                              const decltype(instruments::Sample::value)& value) {
  instruments::Sample sample;
  sample.port = port;
  sample.stamp.validity_ns = sample.stamp.arrival_ns = time_ns;
  sample.value = value;
  return sample;
}

/// Nose up by a tenth of a radian, still, for ten seconds.
void hold_still(TiltStage& stage) {
  for (int i = 0; i < 200; ++i) {
    instruments::ImuSample card;
    card.rate_rad_s = instruments::Vector3{};
    card.specific_force_m_s2 = instruments::Vector3{9.81 * std::sin(0.1), 0, -9.81 * std::cos(0.1)};
    stage.take(sample_of(imu_port, i * kStep_ns, card));
  }
}

instruments::CompassSample with_heading() {
  instruments::CompassSample word;
  word.heading_rad = 1;
  return word;
}

TEST(TiltStage, ACompassWithoutAnInclinometerGetsATilt) {
  TiltStage stage(compass_and_card());
  hold_still(stage);
  auto sample = sample_of(nmea_port, 199 * kStep_ns, with_heading());
  sample = stage.with_tilt(sample).value_or(sample);
  const auto& filled = std::get<instruments::CompassSample>(sample.value);
  EXPECT_TRUE(filled.tilt_by_accelerometers);
  EXPECT_NEAR(filled.pitch_rad.value(), 0.1, 1e-6);
  EXPECT_NEAR(filled.roll_rad.value(), 0, 1e-6);
}

TEST(TiltStage, ACompassWithATiltOfItsOwnKeepsIt) {
  TiltStage stage(compass_and_card());
  hold_still(stage);
  auto word = with_heading();
  word.pitch_rad = word.roll_rad = 0.02;
  auto sample = sample_of(nmea_port, 198 * kStep_ns, word);
  sample = stage.with_tilt(sample).value_or(sample);
  EXPECT_EQ(std::get<instruments::CompassSample>(sample.value).pitch_rad, 0.02);
  auto without = sample_of(nmea_port, 199 * kStep_ns, with_heading());
  without = stage.with_tilt(without).value_or(without);
  EXPECT_FALSE(std::get<instruments::CompassSample>(without.value).pitch_rad) << "it left it out for a reason";
}

TEST(TiltStage, WithoutReadingsOrForOtherLinesThereIsNone) {
  TiltStage stage(compass_and_card());
  auto sample = sample_of(nmea_port, 0, with_heading());
  sample = stage.with_tilt(sample).value_or(sample);
  EXPECT_FALSE(std::get<instruments::CompassSample>(sample.value).pitch_rad);
  hold_still(stage);
  instruments::CompassSample rate_of_turn;
  rate_of_turn.turn_rate_rad_s = 0.1;
  auto line = sample_of(nmea_port, 199 * kStep_ns, rate_of_turn);
  line = stage.with_tilt(line).value_or(line);
  EXPECT_FALSE(std::get<instruments::CompassSample>(line.value).pitch_rad);
  config::Settings no_card;
  no_card.ports.emplace_back().protocol = Protocol::tcm2;
  EXPECT_EQ(TiltStage::make(no_card), nullptr);
}

}  // namespace
}  // namespace navcal::pipeline
