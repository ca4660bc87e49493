// SPDX-License-Identifier: Apache-2.0
// Each device of protocols/device_types.h, from its emulator to its samples: a device that lacks a part fails
// here.
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "analysis/decode_describe.h"
#include "config/load.h"
#include "instruments/start_up.h"
#include "pipeline/pipeline.h"
#include "pipeline/sources.h"
#include "protocols/device_types.h"
#include "sim/instruments/emulators.h"
#include "tests/sim/drive.h"

namespace navcal::analysis {
namespace {

using protocols::DeviceType;
using sim::testing::kSecond_ns;
using sim::testing::kStart_ns;

constexpr std::int64_t kDuration_ns = 40 * kSecond_ns;
constexpr std::int64_t kStep_ns = kSecond_ns / 100;

config::PortSettings port_of(const DeviceType& device) {
  return config::default_port("device", device.protocol, config::default_baud(device.protocol));
}

/// At the surface, north at 1 m/s: fast enough for a course over ground.
struct UnderWay : sim::testing::Still {
  [[nodiscard]] sim::State at(std::int64_t t_ns) const override {
    sim::State now = state;
    now.position_m[0] = static_cast<double>(t_ns - kStart_ns) * 1e-9;
    now.velocity_body_m_s[0] = 1;
    return now;
  }
};

/// A device at its port: the emulator on a vehicle that is under way, the start-up dialogue and the pipeline.
class DeviceAtPort : private pipeline::Sink {
 public:
  explicit DeviceAtPort(const DeviceType& type)
      : emulator_(sim::make_emulator(type.protocol, {}, motion_)),
        start_up_(instruments::make_start_up(port_of(type))), pipeline_(settings_of(type)) {
    emulator_->power_on(kStart_ns);
    if (start_up_) start_up_->begin(kStart_ns);
    for (std::int64_t t_ns = kStart_ns; t_ns < kStart_ns + kDuration_ns; t_ns += kStep_ns) step(t_ns);
  }

  std::vector<std::uint8_t> stream;
  std::vector<instruments::Sample> samples;
  [[nodiscard]] pipeline::PortStatistics statistics() const { return pipeline_.statistics(0); }

 private:
  static config::Settings settings_of(const DeviceType& type) {
    config::Settings settings;
    settings.ports.push_back(port_of(type));
    return settings;
  }
  void step(std::int64_t t_ns) {
    std::vector<sim::Emission> emissions;
    emulator_->advance(t_ns, emissions);
    for (const sim::Emission& emission : emissions) {
      const auto length_ns =
          static_cast<std::int64_t>(emission.bytes.size()) * 10 * kSecond_ns / emulator_->baud();
      stream.insert(stream.end(), emission.bytes.begin(), emission.bytes.end());
      now_ns_ = std::max(now_ns_, emission.start_ns + length_ns);
      pipeline_.bytes(0, now_ns_, emission.bytes, *this);
    }
    if (!start_up_) return;
    while (const auto bytes = start_up_->next(t_ns)) emulator_->on_bytes(t_ns, *bytes);
  }
  void on_sample(const instruments::Sample& sample) override {
    if (sample.port == 0) samples.push_back(sample);
  }
  void on_frame(std::uint16_t, const protocols::Frame& frame, std::int64_t arrival_ns) override {
    if (start_up_) start_up_->on_frame(frame, arrival_ns);
  }

  UnderWay motion_;
  std::unique_ptr<sim::Device> emulator_;
  std::unique_ptr<instruments::StartUp> start_up_;
  pipeline::Pipeline pipeline_;
  std::int64_t now_ns_ = kStart_ns;
};

/// The lines that `navcal decode --json` writes for the frames of a stream.
std::vector<nlohmann::json> decoded(const DeviceType& device, const std::vector<std::uint8_t>& stream,
                                    DecodeSummary& summary) {
  const int file = ::memfd_create("decoded", 0);
  EXPECT_GE(file, 0);
  {
    base::Output output(file, "memory");
    FieldWriter fields(output, FieldWriter::Format::json);
    bool given = false;
    summary = decode_frames(
        device.protocol,
        [&] { return std::exchange(given, true) ? protocols::Bytes{} : protocols::Bytes(stream); },
        [&](const protocols::Frame& frame) {
          fields.begin_frame(device.name, frame);
          description_of(device.protocol)(fields, frame);
          fields.end_frame();
        });
    output.flush();
  }
  std::string text(static_cast<std::size_t>(::lseek(file, 0, SEEK_END)), '\0');
  EXPECT_EQ(::pread(file, text.data(), text.size(), 0), static_cast<ssize_t>(text.size()));
  ::close(file);
  std::vector<nlohmann::json> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(nlohmann::json::parse(line));
  return lines;
}

class EachDevice : public testing::TestWithParam<std::string> {
 protected:
  const DeviceType& row = protocols::device_type(protocols::protocol_named(GetParam()).value());
};

TEST_P(EachDevice, IsDecodedFromWhatItsEmulatorSends) {
  const DeviceAtPort device(row);
  DecodeSummary summary;
  const auto lines = decoded(row, device.stream, summary);
  ASSERT_FALSE(lines.empty());
  EXPECT_EQ(summary.counters.bad_checksum, 0U);
  EXPECT_EQ(summary.counters.skipped_bytes, 0U);
  // What begin_frame() writes of every frame, whatever it holds.
  const std::set<std::string> of_any_frame{"class", "protocol", "id", "offset", "length"};
  std::size_t described = 0;
  for (const auto& line : lines) {
    EXPECT_EQ(line.at("protocol"), row.name);
    EXPECT_FALSE(line.contains("out_of_range")) << line;
    if (std::any_of(line.items().begin(), line.items().end(),
                    [&](const auto& field) { return of_any_frame.count(field.key()) == 0; }))
      ++described;
  }
  // A banner has no fields.
  EXPECT_GT(described, lines.size() / 2);
}

TEST_P(EachDevice, GivesTheSamplesThatItsRowPromises) {
  const DeviceAtPort device(row);
  EXPECT_EQ(device.statistics().out_of_range, 0U);
  EXPECT_EQ(device.statistics().lost, 0U);
  ASSERT_FALSE(device.samples.empty());
  pipeline::RoleSet roles;
  for (const auto& sample : device.samples) {
    for (const config::Role role : config::kRoles) {
      if (pipeline::roles_of(sample).has(role)) roles.add(role);
    }
  }
  EXPECT_FALSE(roles.is_empty());
  for (const config::Role role : config::kRoles) {
    const bool promised = config::can_deliver(row.protocol, role);
    if (roles.has(role)) {
      EXPECT_TRUE(promised) << config::name_of(role);
    }
    // Whether a heading is a true one depends on the device and its setting.
    const bool depends =
        role == config::Role::heading_reference || (role == config::Role::heading && row.heading_if_chosen);
    if (promised && row.delivers_always && !depends) {
      EXPECT_TRUE(roles.has(role)) << config::name_of(role);
    }
  }
}

TEST_P(EachDevice, KeepsTheRateOfItsRow) {
  if (row.rate_Hz == 0) GTEST_SKIP() << "its row states no rate";
  const DeviceAtPort device(row);
  const std::int64_t from_ns = kStart_ns + kDuration_ns / 2;
  // Several samples of one frame, or of frames that belong together, are one tick.
  std::set<std::int64_t> times_ns;
  for (const auto& sample : device.samples) {
    // Satellites in view have the time of their arrival, which is no tick of the device's clock.
    const bool is_tick = !std::holds_alternative<instruments::SkySample>(sample.value);
    if (is_tick && sample.stamp.arrival_ns >= from_ns) times_ns.insert(sample.stamp.validity_ns);
  }
  int ticks = 0;
  std::int64_t before_ns = 0;
  for (const std::int64_t time_ns : times_ns) {
    if (static_cast<double>(time_ns - before_ns) > 0.3e9 / row.rate_Hz) ++ticks;
    before_ns = time_ns;
  }
  const double expected = row.rate_Hz * static_cast<double>(kDuration_ns / 2) * 1e-9;
  EXPECT_NEAR(static_cast<double>(ticks), expected, std::max(2.0, 0.02 * expected));
}

TEST_P(EachDevice, HasUsableDefaults) {
  const DeviceType& device = row;
  EXPECT_TRUE(std::all_of(device.name.begin(), device.name.end(), [](unsigned char c) {
    return std::islower(c) != 0 || std::isdigit(c) != 0 || c == '-';
  })) << device.name;
  EXPECT_EQ(protocols::protocol_named(device.name), device.protocol);
  EXPECT_EQ(protocols::name_of(device.protocol), device.name);
  EXPECT_GT(device.latency_std_s, 0);
  EXPECT_LE(device.latency_std_s, 0.1);
  // parse() refuses what is out of the range of its option.
  const std::string name(device.name);
  const auto settings =
      config::parse("[port.device]\nprotocol = \"" + name + "\"\npath = \"/dev/ttyS0\"\n", "test");
  auto expected = port_of(device);
  expected.path = "/dev/ttyS0";
  EXPECT_EQ(settings.ports.at(0), expected);
  EXPECT_EQ(config::parse(config::to_toml(settings), "again"), settings);
}

TEST_P(EachDevice, HasAStreamFromElsewhereAndAFuzzTarget) {
  const std::string stem = NAVCAL_SOURCE_DIR "/fixtures/decode/" + GetParam();
  std::string target = GetParam();
  std::replace(target.begin(), target.end(), '-', '_');
  EXPECT_TRUE(std::filesystem::exists(NAVCAL_SOURCE_DIR "/tests/fuzz/" + target + ".cpp")) << target;
  EXPECT_TRUE(std::filesystem::exists(stem + ".bin")) << stem;
  EXPECT_TRUE(std::filesystem::exists(stem + ".jsonl")) << stem;
}

std::vector<std::string> names_of_devices() {
  std::vector<std::string> names;
  for (const DeviceType& device : protocols::kDeviceTypes) {
    // A described device is what its file says: described_test.cpp. An autopilot: end_to_end/mavlink_test.cpp.
    if (sim::has_emulator(device.protocol)) names.emplace_back(device.name);
  }
  return names;
}

INSTANTIATE_TEST_SUITE_P(Devices, EachDevice, testing::ValuesIn(names_of_devices()), [](const auto& device) {
  std::string name = device.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

TEST(Devices, HaveNamesAndPortsOfTheirOwn) {
  std::set<std::string_view> names, ports;
  for (const DeviceType& device : protocols::kDeviceTypes) {
    EXPECT_TRUE(names.insert(device.name).second) << device.name;
    if (device.vehicle.name.empty()) continue;
    EXPECT_TRUE(ports.insert(device.vehicle.name).second) << device.vehicle.name;
    EXPECT_GT(device.vehicle.baud, 0) << device.vehicle.name;
  }
}

}  // namespace
}  // namespace navcal::analysis
