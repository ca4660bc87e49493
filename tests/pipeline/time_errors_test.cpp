// SPDX-License-Identifier: Apache-2.0
// The standard error of a sample's time is positive, whatever device it comes from.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "config/described/description_file.h"
#include "config/load.h"
#include "pipeline/pipeline.h"
#include "protocols/device_types.h"
#include "tests/support/temporary_folder.h"

namespace navcal::pipeline {
namespace {

using protocols::Protocol;

class StampKeeper : public Sink {
 public:
  void on_sample(const instruments::Sample& sample) override { samples.push_back(sample); }
  std::vector<instruments::Sample> samples;
};

/// Samples of a stream that arrives some bytes at a time, 10 ms apart.
std::vector<instruments::Sample> samples_of(const config::PortSettings& port, const std::string& bytes,
                                            std::size_t piece) {
  config::Settings settings;
  settings.ports.push_back(port);
  settings.calibration.enabled = settings.navigation.enabled = false;
  Pipeline pipeline(settings);
  StampKeeper keeper;
  pipeline.set_mapping({UtcMapping::Source::gps, 1'700'000'000'000'000'000, 0, 0}, keeper);
  std::int64_t arrival_ns = 5'000'000'000;
  for (std::size_t at = 0; at < bytes.size(); at += piece) {
    const auto* const first = reinterpret_cast<const std::uint8_t*>(bytes.data()) + at;
    pipeline.bytes(0, arrival_ns += 10'000'000, {first, std::min(piece, bytes.size() - at)}, keeper);
  }
  return keeper.samples;
}

class TimeErrors : public testing::TestWithParam<protocols::DeviceType> {};

TEST_P(TimeErrors, ArePositiveForEverySample) {
  const std::string name(GetParam().name);
  const std::string once = navcal::test::read_file(NAVCAL_SOURCE_DIR "/fixtures/decode/" + name + ".bin");
  if (GetParam().protocol == Protocol::described) GTEST_SKIP() << "has a test of its own";
  ASSERT_FALSE(once.empty()) << "no stream of " << name;
  std::string bytes;
  for (int i = 0; i < 40; ++i) bytes += once;  // clocks are found, and see repeated and lost frames
  std::size_t most = 0;
  for (const double rate_Hz : {GetParam().rate_Hz, 0.0}) {
    for (const double latency_std_s : {GetParam().latency_std_s, 0.0}) {
      for (const std::size_t piece : {std::size_t{1} << 20, std::size_t{97}, std::size_t{13}}) {
        config::PortSettings port = config::default_port(name, GetParam().protocol, GetParam().baud);
        port.rate_Hz = rate_Hz;
        port.latency_std_s = latency_std_s;
        const auto samples = samples_of(port, bytes, piece);
        most = std::max(most, samples.size());
        for (const auto& sample : samples)
          ASSERT_GT(sample.stamp.std_ns, 0) << "kind " << sample.value.index() << ", pieces of " << piece;
      }
    }
  }
  EXPECT_GT(most, 0U) << "the stream gives samples";
}

INSTANTIATE_TEST_SUITE_P(AllDevices, TimeErrors, testing::ValuesIn(protocols::kDeviceTypes),
                         [](const auto& device) {
                           std::string name(device.param.name);
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

TEST(TimeErrorsOfDescribedDevices, ArePositive) {
  config::PortSettings port = config::default_port("own", Protocol::described, 9600);
  port.described = config::load_description(NAVCAL_SOURCE_DIR "/share/devices/ctd.toml");
  port.latency_std_s = 0;
  std::string bytes;
  for (int i = 0; i < 40; ++i) bytes += "T=12.3456 C=3.7812 P=10.52 S=31.20\r\n";
  const auto samples = samples_of(port, bytes, 30);
  EXPECT_GT(samples.size(), 40U);
  for (const auto& sample : samples) EXPECT_GT(sample.stamp.std_ns, 0);
}

TEST(TimeErrorsOfDopplerLogs, AttitudeBeforeTheVelocityHasTheErrorOfItsArrival) {
  const std::string once = navcal::test::read_file(NAVCAL_SOURCE_DIR "/fixtures/decode/pd6.bin");
  config::PortSettings port = config::default_port("dvl", Protocol::pd6, 9600);
  port.rate_Hz = 5;
  port.latency_std_s = 0.005;
  bool has_attitude = false;
  for (const auto& sample : samples_of(port, once, 50)) {
    if (!std::holds_alternative<instruments::CompassSample>(sample.value)) continue;
    has_attitude = true;
    EXPECT_EQ(sample.stamp.std_ns, 13'000'000) << "12 ms of an arrival and 5 ms of the latency";
  }
  EXPECT_TRUE(has_attitude);
}

TEST(TimeErrorsOfSenders, AStatedZeroSaysNothing) {
  config::PortSettings port = config::default_port("own", Protocol::samples, 9600);
  const std::string line = R"({"class":"DEPTH","depth_m":3,"time":1700000004.5,"time_std":0})"
                           "\n";
  port.latency_std_s = 0.002;
  EXPECT_EQ(samples_of(port, line, 1000).at(0).stamp.std_ns, 2'000'000);
  port.latency_std_s = 0;
  EXPECT_EQ(samples_of(port, line, 1000).at(0).stamp.std_ns, 1'000'000) << "of an arrival";
}

}  // namespace
}  // namespace navcal::pipeline
