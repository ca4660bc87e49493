// SPDX-License-Identifier: Apache-2.0
// The lines of a layout's outputs, and the description by which they are read.
#include "sim/instruments/actuator_outputs.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/support/temporary_folder.h"

namespace navcal::sim::testing {
namespace {

/// Has these outputs at 0 s, 0.1 s, ...
class Told final : public Motion {
 public:
  explicit Told(std::vector<std::vector<double>> pulses) : pulses_(std::move(pulses)) {}
  [[nodiscard]] State at(std::int64_t) const override { return {}; }
  void take_outputs(std::int64_t t_ns, std::vector<OutputOrder>& out) const override {
    for (; next_ < pulses_.size() && static_cast<std::int64_t>(next_) * 100'000'000 <= t_ns; ++next_)
      out.push_back({static_cast<std::int64_t>(next_) * 100'000'000, pulses_[next_]});
  }

 private:
  std::vector<std::vector<double>> pulses_;
  mutable std::size_t next_ = 0;
};

std::string sent_text(const Emission& emission) { return {emission.bytes.begin(), emission.bytes.end()}; }

TEST(ActuatorOutputs, SayWhatWasToldAfterTheirLatency) {
  const Told motion({{1500, 1620, 1500, 1500}, {1501, 1621, 1500, 1500}});
  ActuatorOutputs device(motion);
  device.power_on(0);
  std::vector<Emission> out;
  device.advance(104'999'999, out);
  ASSERT_EQ(out.size(), 1U);
  EXPECT_EQ(sent_text(out[0]), "$PNCAO,1500,1620,1500,1500,,,,*52\r\n");
  EXPECT_EQ(out[0].start_ns, 5'000'000);
  device.advance(105'000'000, out);
  EXPECT_EQ(out.size(), 2U);
}

TEST(ActuatorOutputs, HaveASecondLineForMoreThanEight) {
  const Told motion({std::vector<double>(10, 1500.0)});
  ActuatorOutputs device(motion);
  device.power_on(0);
  std::vector<Emission> out;
  device.advance(10'000'000, out);
  ASSERT_EQ(out.size(), 2U);
  EXPECT_EQ(sent_text(out[1]).substr(0, 23), "$PNCAP,1500,1500,,,,,,*");
}

TEST(ActuatorOutputs, ObeyIntactLinesOnly) {
  const Told motion({});
  std::vector<std::vector<std::optional<double>>> orders;
  ActuatorOutputs device(motion, [&](std::int64_t, const auto& pulses) { orders.push_back(pulses); });
  device.power_on(0);
  ASSERT_EQ(orders.size(), 1U);
  EXPECT_EQ(orders[0][15], 1500);
  const auto write = [&](const std::string& text) {
    device.on_bytes(0, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  };
  write("$PNCAO,1500,1620,1500,1500,,,,*53\r\n");
  write("$PNCAO,9999,1620,1500,1500,,,,*58\r\n");
  write("$GPGGA,1*4A\r\n");
  EXPECT_EQ(orders.size(), 1U) << "a wrong checksum, a pulse that cannot be, another sentence";
  write("$PNCAO,1500,1620,1500,1500,,,,*52\r\n");
  ASSERT_EQ(orders.size(), 2U);
  EXPECT_EQ(orders[1][1], 1620);
  EXPECT_FALSE(orders[1][4]);
}

}  // namespace
}  // namespace navcal::sim::testing
