// SPDX-License-Identifier: Apache-2.0
// The start-up dialogue of a MicroStrain sensor against the emulated one, on simulated time.
#include <gtest/gtest.h>

#include <functional>

#include "base/durations.h"
#include "instruments/start_up.h"
#include "protocols/mip.h"
#include "sim/instruments/mip_unit.h"
#include "tests/instruments/dialogue.h"

namespace navcal::instruments::test {
namespace {

namespace mip = protocols::mip;

struct StillVehicle : sim::Motion {
  [[nodiscard]] sim::State at(std::int64_t) const override { return {}; }
};

class MipBench {
 public:
  explicit MipBench(const sim::MipUnit::Options& options = {}) : unit_(options, motion_) {
    config::PortSettings port;
    port.protocol = protocols::Protocol::mip;
    port.rate_Hz = 50;
    start_up = make_start_up(port);
    unit_.power_on(now_ns);
    start_up->begin(now_ns);
  }
  void run_for(double seconds) {
    const std::int64_t end_ns = now_ns + static_cast<std::int64_t>(seconds * 1e9);
    for (; now_ns < end_ns; now_ns += base::kMillisecond_ns) {
      std::vector<sim::Emission> emissions;
      unit_.advance(now_ns, emissions);
      for (const auto& emission : emissions) {
        parser_.feed(emission.bytes, [&](const protocols::Frame& frame) {
          if (frame.id.view() == "80") ++sensor_packets;
          if (frame.id.view() == "82") ++filter_packets;
          if (passes(frame.id.view())) start_up->on_frame(frame, now_ns);
        });
      }
      if (start_up->deadline_ns() > now_ns) continue;
      while (const auto bytes = start_up->next(now_ns)) {
        sent.push_back({now_ns, {bytes->begin(), bytes->end()}});
        if (hears) unit_.on_bytes(now_ns, *bytes);
      }
    }
  }
  /// Set and descriptor of each command.
  [[nodiscard]] std::string transcript() const {
    constexpr std::string_view kDigits = "0123456789ABCDEF";
    std::string text;
    for (const Sent& command : sent) {
      for (const std::size_t at : {2U, 5U}) {
        const auto byte = static_cast<std::uint8_t>(command.text[at]);
        text += kDigits[byte >> 4];
        text += kDigits[byte & 0x0F];
      }
      text += ' ';
    }
    return text;
  }
  void power_cycle() { unit_.power_on(now_ns); }

  std::unique_ptr<StartUp> start_up;
  std::vector<Sent> sent;
  bool hears = true;
  std::function<bool(std::string_view)> passes = [](std::string_view) { return true; };
  int sensor_packets = 0, filter_packets = 0;
  std::int64_t now_ns = 1'764'000'000 * base::kSecond_ns;

 private:
  StillVehicle motion_;
  sim::MipUnit unit_;
  mip::Parser parser_;
};

constexpr const char* kMipWhole = "0101 0102 0C0E 0C0E 0C0F 0C0F 0C11 0C11 0106 ";

TEST(StartUpMip, ConfiguresBothSetsAndRuns) {
  MipBench bench;
  EXPECT_EQ(bench.start_up->state(), "asking for an answer");
  bench.run_for(20);
  EXPECT_EQ(bench.transcript(), kMipWhole);
  EXPECT_EQ(bench.start_up->state(), "running on D5 04 05 06 0C, filter D5 05 0A 10");
  EXPECT_NEAR(bench.sensor_packets, 1000, 20) << "50 Hz";
  EXPECT_NEAR(bench.filter_packets, 200, 10);
}

TEST(StartUpMip, AnOlderDeviceGetsTheOlderCommands) {
  sim::MipUnit::Options options;
  options.newer_commands = false;
  MipBench bench(options);
  bench.run_for(20);
  EXPECT_EQ(bench.transcript(), "0101 0102 0C0E 0C06 0C0B 0C08 0C08 0C08 0C0A 0C0A 0C11 0C11 0106 ");
  EXPECT_EQ(bench.start_up->state(), "running on 12 04 05 06 0C, filter 11 05 0A 10");
  EXPECT_NEAR(bench.sensor_packets, 1000, 20);
}

TEST(StartUpMip, ADeviceWithoutFilterGivesSensorData) {
  sim::MipUnit::Options options;
  options.has_filter = options.has_complementary = false;
  MipBench bench(options);
  bench.run_for(10);
  EXPECT_EQ(bench.transcript(), "0101 0102 0C0E 0C0E 0C0F 0C0F 0C11 0106 ");
  EXPECT_EQ(bench.start_up->state(), "running on D5 04 05 06");
  EXPECT_GT(bench.sensor_packets, 450);
}

TEST(StartUpMip, LostAnswersAreRepeated) {
  MipBench bench;
  int answers = 0;
  bench.passes = [&](std::string_view id) { return id.starts_with("8") || ++answers % 2 == 0; };
  bench.run_for(15);
  EXPECT_EQ(bench.start_up->state().rfind("running", 0), 0U) << bench.start_up->state();
  EXPECT_EQ(bench.transcript(),
            "0101 0101 0102 0102 0C0E 0C0E 0C0E 0C0E 0C0F 0C0F 0C0F 0C0F 0C11 0C11 0C11 0C11 0106 0106 ");
}

TEST(StartUpMip, ADeviceThatDoesNotHearIsAskedEveryTenSeconds) {
  MipBench bench;
  bench.hears = false;
  bench.run_for(31);
  EXPECT_EQ(bench.sent.size(), 9U);
  EXPECT_EQ(bench.start_up->state().rfind("no answer to ping: trying again every 10 s", 0), 0U);
  bench.hears = true;
  bench.run_for(20);
  EXPECT_EQ(bench.start_up->state().rfind("running", 0), 0U) << bench.start_up->state();
}

TEST(StartUpMip, BeginsAnewWhenTheDeviceHasLostItsPower) {
  MipBench bench;
  bench.run_for(5);
  bench.power_cycle();
  bench.run_for(10);
  EXPECT_EQ(bench.transcript(), std::string(kMipWhole) + kMipWhole);
  EXPECT_EQ(bench.start_up->state().rfind("running", 0), 0U);
}

TEST(StartUpMip, BeginsAnewWhenTheDevicesClockDoes) {
  MipBench bench;
  bench.run_for(5);
  mip::Packet packet;
  packet.set = mip::kSensorSet;
  packet.reference_time_ns = 1;
  const auto bytes = mip::encode(packet);
  bench.start_up->on_frame({mip::id_of(packet.set), 0, bytes}, bench.now_ns);
  bench.run_for(5);
  EXPECT_EQ(bench.transcript(), std::string(kMipWhole) + kMipWhole);
}

}  // namespace
}  // namespace navcal::instruments::test
