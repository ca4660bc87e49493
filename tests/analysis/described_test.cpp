// SPDX-License-Identifier: Apache-2.0
// Described devices from bytes to samples: those of the shipped descriptions give what the built-in drivers give,
// bit for bit; and what `navcal devices` finds in captures.
#include <gtest/gtest.h>

#include <bit>
#include <fstream>
#include <random>

#include "analysis/device_check.h"
#include "analysis/device_guess.h"
#include "analysis/failure.h"
#include "config/described/description_file.h"
#include "config/load.h"
#include "instruments/instrument.h"
#include "instruments/start_up.h"
#include "pipeline/pipeline.h"
#include "protocols/checked_line.h"
#include "protocols/described/encode.h"
#include "protocols/imu_card.h"
#include "protocols/pd0.h"
#include "sim/instruments/emulators.h"
#include "tests/sim/drive.h"
#include "tests/support/temporary_folder.h"

namespace navcal::analysis {
namespace {

using instruments::AltimeterSample;
using instruments::CompassSample;
using instruments::DepthSample;
using instruments::DvlSample;
using instruments::ImuSample;
using instruments::Sample;
using instruments::ScalarSample;
using protocols::described::Description;
using sim::testing::kSecond_ns;
using sim::testing::kStart_ns;
using Octets = std::vector<std::uint8_t>;

const std::filesystem::path kShipped = NAVCAL_SOURCE_DIR "/share/devices";

config::PortSettings described_port(const std::filesystem::path& file) {
  const test::TemporaryFolder folder;
  std::ofstream(folder / "navcald.toml")
      << "[port.device]\nprotocol = \"described\"\npath = \"/dev/ttyS0\"\ndevice = \"" << file.native() << "\"\n";
  return config::load(folder / "navcald.toml").ports.at(0);
}

config::PortSettings described_port_of(std::string_view toml) {
  const test::TemporaryFolder folder;
  std::ofstream(folder / "device.toml") << toml;
  return described_port(folder / "device.toml");
}

config::PortSettings built_in_port(protocols::Protocol protocol) {
  return config::default_port("device", protocol, config::default_baud(protocol));
}

struct Read {
  std::int64_t arrival_ns = 0;
  Octets bytes;
};

/// What the pipeline makes of reads.
struct Samples : pipeline::Sink {
  explicit Samples(const config::PortSettings& port) : pipeline(settings_of(port)) {}
  static config::Settings settings_of(const config::PortSettings& port) {
    config::Settings settings;
    settings.ports.push_back(port);
    return settings;
  }
  void take(const std::vector<Read>& reads) {
    for (const Read& read : reads) pipeline.bytes(0, read.arrival_ns, read.bytes, *this);
  }
  void on_sample(const Sample& sample) override { samples.push_back(sample); }

  pipeline::Pipeline pipeline;
  std::vector<Sample> samples;
};

std::uint64_t bits(double value) { return std::bit_cast<std::uint64_t>(value); }
std::uint64_t bits(const std::optional<double>& value) { return value ? bits(*value) : 1; }

void expect_same(const instruments::Stamp& a, const instruments::Stamp& b) {
  EXPECT_EQ(a.arrival_ns, b.arrival_ns);
  EXPECT_EQ(a.validity_ns, b.validity_ns);
  EXPECT_EQ(a.std_ns, b.std_ns);
  EXPECT_EQ(a.arrival_utc_ns, b.arrival_utc_ns);
  EXPECT_EQ(a.validity_utc_ns, b.validity_utc_ns);
}

void expect_same(const ImuSample& a, const ImuSample& b) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    EXPECT_EQ(bits(a.rate_rad_s.value()[axis]), bits(b.rate_rad_s.value()[axis])) << axis;
    EXPECT_EQ(bits(a.specific_force_m_s2.value()[axis]), bits(b.specific_force_m_s2.value()[axis])) << axis;
  }
  EXPECT_EQ(bits(a.yaw_rate_b_rad_s), bits(b.yaw_rate_b_rad_s));
  EXPECT_EQ(bits(a.depth_m), bits(b.depth_m));
  EXPECT_EQ(bits(a.temperature_C), bits(b.temperature_C));
  EXPECT_EQ(a.over_range, b.over_range);
  ASSERT_EQ(a.card.has_value(), b.card.has_value());
  EXPECT_EQ(a.card->sequence, b.card->sequence);
  EXPECT_EQ(a.card->leak_forward, b.card->leak_forward);
  EXPECT_EQ(a.card->leak_aft, b.card->leak_aft);
  EXPECT_EQ(a.card->low_supply, b.card->low_supply);
  EXPECT_EQ(bits(a.rate_std_rad_s), bits(b.rate_std_rad_s));
  EXPECT_EQ(bits(a.specific_force_std_m_s2), bits(b.specific_force_std_m_s2));
  EXPECT_EQ(bits(a.depth_std_m), bits(b.depth_std_m));
}

/// A vehicle that turns, pitches and dives, so that all channels move.
struct Moving : sim::testing::Still {
  [[nodiscard]] sim::State at(std::int64_t t_ns) const override {
    sim::State now = state;
    const double t_s = static_cast<double>(t_ns - kStart_ns) * 1e-9;
    now.position_m[2] = 3 + 2 * std::sin(t_s / 7);
    now.rate_rad_s = {0.3 * std::sin(t_s), 0.2 * std::cos(2 * t_s), 0.5 * std::sin(t_s / 3)};
    return now;
  }
};

/// A recording of the emulated inertial card, cut into reads that do not keep to its frames.
std::vector<Read> card_recording(int seconds) {
  const Moving motion;
  const auto emulator = sim::make_emulator(protocols::Protocol::imu_card, {}, motion);
  emulator->power_on(kStart_ns);
  std::vector<Read> reads;
  std::mt19937_64 random(3);  // NOLINT: the same reads in every run
  std::int64_t now_ns = kStart_ns;
  for (std::int64_t t_ns = kStart_ns; t_ns < kStart_ns + seconds * kSecond_ns; t_ns += kSecond_ns / 50) {
    std::vector<sim::Emission> emissions;
    emulator->advance(t_ns, emissions);
    for (const sim::Emission& emission : emissions) {
      now_ns = std::max(now_ns + 1, emission.start_ns + 5'000'000);
      const std::size_t cut = random() % (emission.bytes.size() + 1);
      reads.push_back(
          {now_ns, Octets(emission.bytes.begin(), emission.bytes.begin() + static_cast<std::ptrdiff_t>(cut))});
      reads.push_back({now_ns + 400'000,
                       Octets(emission.bytes.begin() + static_cast<std::ptrdiff_t>(cut), emission.bytes.end())});
      now_ns += 400'000;
    }
  }
  std::erase_if(reads, [](const Read& read) { return read.bytes.empty(); });
  return reads;
}

void expect_same_imu(const std::vector<Sample>& built_in, const std::vector<Sample>& described) {
  ASSERT_EQ(built_in.size(), described.size());
  for (std::size_t i = 0; i < built_in.size(); ++i) {
    expect_same(built_in[i].stamp, described[i].stamp);
    expect_same(std::get<ImuSample>(built_in[i].value), std::get<ImuSample>(described[i].value));
    if (testing::Test::HasFailure()) FAIL() << "sample " << i;
  }
}

TEST(ShippedDevices, TheInertialCardGivesTheSamplesOfItsDriverBitForBit) {
  Samples built_in(built_in_port(protocols::Protocol::imu_card)),
      described(described_port(kShipped / "thesis-imu-card.toml"));
  const auto recording = card_recording(60);
  built_in.take(recording);
  described.take(recording);
  ASSERT_GT(built_in.samples.size(), 1000U);
  expect_same_imu(built_in.samples, described.samples);
  EXPECT_EQ(built_in.pipeline.statistics(0).lost, described.pipeline.statistics(0).lost);
}

TEST(ShippedDevices, SoItDoesOfAnyContentWithDamageBetween) {
  std::mt19937_64 random(7);  // NOLINT: the same stream in every run
  std::vector<Read> reads;
  for (int i = 0; i < 3000; ++i) {
    protocols::imu_card::Record record{static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(random() % 16), {}};
    for (auto& raw : record.raw) raw = static_cast<std::uint16_t>(random());
    const auto frame = protocols::imu_card::encode_record(record);
    Octets bytes(frame.begin(), frame.end());
    if (random() % 8 == 0) bytes[random() % bytes.size()] ^= static_cast<std::uint8_t>(1U << random() % 8);
    if (random() % 8 == 0) bytes.resize(random() % bytes.size() + 1);
    reads.push_back({kStart_ns + i * kSecond_ns / 20, bytes});
  }
  Samples built_in(built_in_port(protocols::Protocol::imu_card)),
      described(described_port(kShipped / "thesis-imu-card.toml"));
  built_in.take(reads);
  described.take(reads);
  // A gyro at the end of its range turns by 200 deg/s: nothing that the description would refuse.
  expect_same_imu(built_in.samples, described.samples);
  const auto a = built_in.pipeline.statistics(0), b = described.pipeline.statistics(0);
  EXPECT_EQ(a.bytes.frames, b.bytes.frames);
  EXPECT_EQ(a.bytes.bad_checksum, b.bytes.bad_checksum);
  EXPECT_EQ(a.bytes.skipped_bytes, b.bytes.skipped_bytes);
  EXPECT_GT(a.bytes.bad_checksum, 100U);
}

TEST(ShippedDevices, AnAdjustedCardGivesTheSamplesOfAnAdjustedDriver) {
  auto built_in = built_in_port(protocols::Protocol::imu_card);
  built_in.imu_card.zero_mV[0] = 2051.25;
  built_in.imu_card.scale[4] = -997.5;
  auto described = described_port(kShipped / "thesis-imu-card.toml");
  ASSERT_EQ(config::adjust(*described.described, "rate.x: zero = 2051.25"), std::nullopt);
  ASSERT_EQ(config::adjust(*described.described, "specific_force.x: sensitivity = -997.5"), std::nullopt);
  Samples one(built_in), other(described);
  const auto recording = card_recording(10);
  one.take(recording);
  other.take(recording);
  expect_same_imu(one.samples, other.samples);
}

TEST(ShippedDevices, DptGivesTheSamplesOfTheNmeaDriverBitForBit) {
  std::mt19937_64 random(5);  // NOLINT: the same lines in every run
  std::vector<Read> reads;
  const std::vector<std::string> numbers{"", "0.0", "-1.5", "12000.01", "+3", "1e3", "x", ".", "007.250", "2.5 "};
  for (int i = 0; i < 2000; ++i) {
    const auto pick = [&] { return numbers[random() % numbers.size()]; };
    const std::string depth = random() % 2 == 0 ? std::to_string(random() % 100000) : pick();
    std::string body = "IIDPT," + std::to_string(random() % 300) + "." + depth.substr(0, 3);
    if (random() % 4 == 0) body = "IIDPT," + pick();
    if (random() % 2 == 0) body += "," + (random() % 8 == 0 ? pick() : std::string("0.3"));
    if (random() % 4 == 0) body += ",100";
    auto bytes = protocols::checked_line(body);
    if (random() % 10 == 0) bytes[random() % bytes.size()] ^= static_cast<std::uint8_t>(1U << random() % 8);
    reads.push_back({kStart_ns + i * kSecond_ns, bytes});
  }
  auto nmea = built_in_port(protocols::Protocol::nmea);
  Samples built_in(nmea), described(described_port(kShipped / "nmea-dpt.toml"));
  built_in.take(reads);
  described.take(reads);
  std::vector<Sample> depths;
  for (const Sample& sample : built_in.samples) {
    if (std::holds_alternative<AltimeterSample>(sample.value)) depths.push_back(sample);
  }
  ASSERT_GT(depths.size(), 1000U);
  ASSERT_EQ(depths.size(), described.samples.size());
  for (std::size_t i = 0; i < depths.size(); ++i) {
    expect_same(depths[i].stamp, described.samples[i].stamp);
    const auto &a = std::get<AltimeterSample>(depths[i].value),
               &b = std::get<AltimeterSample>(described.samples[i].value);
    EXPECT_EQ(bits(a.altitude_m), bits(b.altitude_m));
    EXPECT_EQ(bits(a.altitude_std_m), bits(b.altitude_std_m));
  }
}

TEST(ShippedDevices, TheHomeMadeUnitGivesRatesFieldAndTemperatureOfOneTime) {
  Samples unit(described_port(kShipped / "csv-imu.toml"));
  const std::string line = "IMU,7,90,-0.31,0.02,0.013,-0.027,-0.998,21.4,-3.2,40.1,23.5\r\n";
  unit.take({{kStart_ns, Octets(line.begin(), line.end())}});
  ASSERT_EQ(unit.samples.size(), 2U);
  const auto& imu = std::get<ImuSample>(unit.samples[0].value);
  EXPECT_NEAR(imu.rate_rad_s.value()[0], 1.5707963267948966, 1e-15);
  EXPECT_NEAR(imu.specific_force_m_s2.value()[2], -0.998 * 9.81, 1e-12);
  EXPECT_EQ(imu.temperature_C, 23.5);
  EXPECT_FALSE(imu.card);
  const auto& compass = std::get<CompassSample>(unit.samples[1].value);
  EXPECT_EQ(compass.field_body_uT.value(), (instruments::Vector3{21.4, -3.2, 40.1}));
  EXPECT_EQ(unit.samples[0].stamp.validity_ns, unit.samples[1].stamp.validity_ns);
  EXPECT_EQ(unit.samples[0].stamp.std_ns, unit.samples[1].stamp.std_ns);
}

TEST(ShippedDevices, TheWaterSensorGivesPressureAndMissionSensors) {
  Samples sensor(described_port(kShipped / "ctd.toml"));
  const std::string line = "T=12.5 C=3.75 P=20.5 S=31\r\n";
  sensor.take({{kStart_ns, Octets(line.begin(), line.end())}});
  ASSERT_EQ(sensor.samples.size(), 3U);
  const auto& depth = std::get<DepthSample>(sensor.samples[0].value);
  EXPECT_EQ(depth.pressure_Pa, 205000);
  EXPECT_EQ(depth.temperature_C, 12.5);
  EXPECT_FALSE(depth.depth_m);
  const auto& conductivity = std::get<ScalarSample>(sensor.samples[1].value);
  EXPECT_EQ(conductivity.quantity.view(), "conductivity");
  EXPECT_EQ(conductivity.unit.view(), "S/m");
  EXPECT_EQ(conductivity.value, 3.75);
  EXPECT_EQ(conductivity.value_std, 0.003);
  EXPECT_EQ(std::get<ScalarSample>(sensor.samples[2].value).value, 31);
}

constexpr std::string_view kDopplerLog =
    "form = \"binary\"\n[[frame]]\nid = \"D\"\nsync = \"D0 17\"\nlength = 14\nchecksum = { kind = \"crc8\", from "
    "= 0 }\n"
    "field = [\n"
    "{ meaning = \"bottom_velocity.north\", at = 2, type = \"i16\", unit = \"mm/s\", absent = -32768, std = 10 "
    "},\n"
    "{ meaning = \"bottom_velocity.east\", at = 4, type = \"i16\", unit = \"mm/s\", absent = -32768 },\n"
    "{ meaning = \"bottom_velocity.down\", at = 6, type = \"i16\", unit = \"mm/s\", absent = -32768 },\n"
    "{ meaning = \"altitude\", at = 8, type = \"u16\", unit = \"cm\", absent = 0 },\n"
    "{ meaning = \"utc\", at = 10, type = \"u24\", unit = \"s\" },\n]\n";

TEST(DescribedSamples, ADopplerLogLosesAndFindsTheBottom) {
  const auto port = described_port_of(kDopplerLog);
  Samples log(port);
  const auto& kind = port.described->kinds[0];
  const double absent = std::numeric_limits<double>::quiet_NaN();
  log.take({{kStart_ns, encode(*port.described, kind, std::vector<double>{100, -200, 30, 1250, 1000000})},
            {kStart_ns + kSecond_ns,
             encode(*port.described, kind, std::vector<double>{absent, absent, absent, absent, 1000001})}});
  ASSERT_EQ(log.samples.size(), 2U);
  const auto& locked = std::get<DvlSample>(log.samples[0].value);
  EXPECT_EQ(locked.frame, instruments::VelocityFrame::earth);
  EXPECT_EQ(locked.bottom_velocity_m_s.value()[1], -200 * 1e-3);
  EXPECT_EQ(locked.bottom_velocity_std_m_s, 10 * 1e-3);
  EXPECT_EQ(locked.altitude_m, 1250 * 1e-2);
  EXPECT_EQ(log.samples[0].stamp.validity_utc_ns, 1'000'000'000'000'000);
  const auto& lost = std::get<DvlSample>(log.samples[1].value);
  EXPECT_FALSE(lost.bottom_velocity_m_s);
  EXPECT_FALSE(lost.altitude_m);
}

TEST(DescribedSamples, WithoutADescriptionAllIsSkipped) {
  Samples nothing(built_in_port(protocols::Protocol::described));
  nothing.take(card_recording(1));
  EXPECT_TRUE(nothing.samples.empty());
  const auto counters = nothing.pipeline.statistics(0).bytes;
  EXPECT_EQ(counters.skipped_bytes, counters.bytes);
}

TEST(DescribedStartUp, LinesAreSentWithPausesAndAgainAfterSilence) {
  const auto port = described_port(kShipped / "ctd.toml");
  const auto start_up = instruments::make_start_up(port);
  ASSERT_TRUE(start_up);
  start_up->begin(0);
  std::vector<std::string> sent;
  const auto advance = [&](std::int64_t to_ns) {
    for (std::int64_t now_ns = 0; now_ns <= to_ns; now_ns += kSecond_ns / 10) {
      while (const auto bytes = start_up->next(now_ns)) sent.emplace_back(bytes->begin(), bytes->end());
    }
  };
  EXPECT_TRUE(start_up->next(0).has_value());
  EXPECT_FALSE(start_up->next(0).has_value());
  advance(kSecond_ns);
  EXPECT_EQ(sent, (std::vector<std::string>{"interval 0.5\r\n", "start\r\n"}));
  advance(9 * kSecond_ns);
  EXPECT_EQ(sent.size(), 2U);
  advance(12 * kSecond_ns);
  EXPECT_EQ(sent.size(), 5U);
  const auto imu = described_port(kShipped / "thesis-imu-card.toml");
  EXPECT_FALSE(instruments::make_start_up(imu));
}

TEST(DevicesPage, ItsExampleReadsAsThePageSays) {
  const std::string page = test::read_file(NAVCAL_SOURCE_DIR "/docs/devices.md");
  constexpr std::string_view kBegin = "```toml\n";
  const std::size_t begin = page.find(kBegin) + kBegin.size();
  const auto port = described_port_of(std::string_view(page).substr(begin, page.find("```", begin) - begin));
  Samples device(port);
  device.take({{kStart_ns, {0xBE, 0xEF, 0x00, 0x12, 0xFE, 0x4C, 0x00, 0x03, 0xFF, 0x41, 0x9F}}});
  ASSERT_EQ(device.samples.size(), 1U);
  const auto& imu = std::get<ImuSample>(device.samples[0].value);
  EXPECT_NEAR(imu.rate_rad_s.value()[0], 0.8486, 5e-5);
  EXPECT_NEAR(imu.rate_rad_s.value()[1], 3.3957, 5e-5);
  EXPECT_NEAR(imu.rate_rad_s.value()[2], 0.1785, 5e-5);
  EXPECT_EQ(imu.temperature_C, 25);
}

/// All of a capture in one piece.
DeviceFindings checked(const Description& description, const Octets& capture) {
  bool given = false;
  return check_device(description, [&] {
    return std::exchange(given, true) ? TimedBytes{} : TimedBytes{capture, std::nullopt};
  });
}

Octets bytes_of_reads(const std::vector<Read>& reads) {
  Octets all;
  for (const Read& read : reads) all.insert(all.end(), read.bytes.begin(), read.bytes.end());
  return all;
}

TEST(DevicesCheck, CountsRangesAndPlacesOfWhatIsSkipped) {
  const auto description = config::load_description(kShipped / "thesis-imu-card.toml");
  Octets capture{1, 2, 3};
  const Octets good = bytes_of_reads(card_recording(10));
  capture.insert(capture.end(), good.begin(), good.end());
  capture[3 + 5 * 22 + 9] ^= 4;
  capture.insert(capture.end(), {0xA5, 0x5A, 0});
  const DeviceFindings findings = checked(description, capture);
  const auto frames = good.size() / 22;
  EXPECT_EQ(findings.summary.counters.frames, frames - 1);
  EXPECT_EQ(findings.summary.counters.bad_checksum, 1U);
  EXPECT_EQ(findings.summary.incomplete_bytes, 3U);
  ASSERT_EQ(findings.skipped.size(), 2U);
  EXPECT_EQ(findings.skipped[0].offset, 0U);
  EXPECT_EQ(findings.skipped[0].first_bytes, std::string("\1\2\3"));
  EXPECT_EQ(findings.skipped[1].offset, 3U + 5 * 22);
  EXPECT_EQ(findings.skipped[1].length, 22U);
  const auto& depth = findings.kinds.at(0).fields.back();
  EXPECT_EQ(depth.name, "depth");
  EXPECT_EQ(depth.values, frames - 1);
  EXPECT_GT(depth.high, depth.low);
  EXPECT_EQ(findings.kinds[0].impossible, 0U);
}

TEST(DevicesCheck, WarnsOfAWrongUnitAndOfWhatNeverChanges) {
  Description description = config::load_description(kShipped / "thesis-imu-card.toml");
  for (auto& field : description.kinds[0].fields) {
    if (field.name.starts_with("specific_force")) field.factor = 1;
    if (field.name == "depth") field.at = 3;
    if (field.name == "depth") field.type = protocols::described::Type::u8;
  }
  const auto findings = checked(description, bytes_of_reads(card_recording(10)));
  const auto warned = [&](std::string_view words) {
    return std::any_of(findings.warnings.begin(), findings.warnings.end(),
                       [&](const std::string& warning) { return warning.find(words) != std::string::npos; });
  };
  EXPECT_TRUE(warned("gravity is 9.81"));
  EXPECT_TRUE(warned("depth never changes"));
  EXPECT_TRUE(config::load_description(kShipped / "thesis-imu-card.toml").kinds.size() == 1);
  EXPECT_EQ(
      checked(config::load_description(kShipped / "thesis-imu-card.toml"), bytes_of_reads(card_recording(10)))
          .warnings,
      std::vector<std::string>{});
}

TEST(DevicesCheck, AnEmptyAndAForeignCapture) {
  const auto description = config::load_description(kShipped / "nmea-dpt.toml");
  EXPECT_EQ(checked(description, {}).warnings.front(), "the capture is empty");
  const auto findings = checked(description, bytes_of_reads(card_recording(5)));
  EXPECT_EQ(findings.summary.counters.frames, 0U);
  EXPECT_GE(findings.warnings.size(), 2U);
}

/// What the guessed description finds of its own capture.
DeviceFindings guessed(const Octets& capture, Description& description) {
  const std::string toml = guess_description(capture, std::nullopt);
  description = config::parse_description(toml, "guess");
  return checked(description, capture);
}

TEST(DevicesNew, FindsTheFramesAndTheChecksumOfTheInertialCard) {
  const Octets capture = bytes_of_reads(card_recording(30));
  Description description;
  const auto findings = guessed(capture, description);
  EXPECT_EQ(findings.summary.counters.framed_bytes, capture.size());
  const auto& kind = description.kinds.at(0);
  EXPECT_EQ(kind.start, "\xA5\x5A");
  EXPECT_EQ(kind.length.fixed, 22U);
  EXPECT_EQ(kind.checksum.sum, protocols::described::Sum::crc16_ccitt);
  EXPECT_EQ(kind.checksum.from, 2);
  EXPECT_EQ(kind.fields.at(0).type, protocols::described::Type::u8);  // the sequence counts
}

TEST(DevicesNew, FindsEachChecksumByItsName) {
  for (std::size_t i = 1; i < protocols::described::kSumCount; ++i) {
    const auto sum = static_cast<protocols::described::Sum>(i);
    Description device = config::load_description(kShipped / "thesis-imu-card.toml");
    auto& kind = device.kinds[0];
    const int size = static_cast<int>(size_of(sum));
    kind.checksum = {sum, 2, -size, -size, protocols::described::ByteOrder::big, '*'};
    kind.length.fixed = 20 + size_of(sum);
    std::mt19937_64 random(i);  // NOLINT: the same in every run
    Octets capture;
    for (int frame = 0; frame < 60; ++frame) {
      std::vector<double> values;
      for (const auto& field : kind.fields)
        values.push_back(field.bits > 0 ? 0
                         : field.name == "sequence"
                             ? frame
                             : (32768 + static_cast<double>(random() % 900)) / 16 / field.sensitivity -
                                   field.zero / field.sensitivity);
      const auto bytes = encode(device, kind, values);
      capture.insert(capture.end(), bytes.begin(), bytes.end());
    }
    Description description;
    const auto findings = guessed(capture, description);
    EXPECT_EQ(findings.summary.counters.framed_bytes, capture.size()) << name_of(sum);
    EXPECT_EQ(name_of(description.kinds.at(0).checksum.sum), name_of(sum));
  }
}

TEST(DevicesNew, FindsALengthThatTheFramesState) {
  Description device;
  protocols::described::FrameKind kind;
  kind.id = protocols::FrameId("V");
  kind.start = "\xC3\x3C";
  kind.length = {0, 3, protocols::described::Type::u8, protocols::described::ByteOrder::little, 1, 6, 300};
  kind.checksum = {protocols::described::Sum::crc16_xmodem, 2,  -2, -2,
                   protocols::described::ByteOrder::little, '*'};
  device.kinds = {kind};
  std::mt19937_64 random(1);  // NOLINT: the same in every run
  Octets capture;
  for (int i = 0; i < 200; ++i) {
    auto longer = kind;
    protocols::described::Field field;
    field.at = static_cast<std::uint16_t>(4 + random() % 20);
    longer.fields = {field};
    const auto bytes = encode(device, longer, std::vector<double>{static_cast<double>(random() % 256)});
    capture.insert(capture.end(), bytes.begin(), bytes.end());
  }
  Description description;
  const auto findings = guessed(capture, description);
  EXPECT_EQ(findings.summary.counters.framed_bytes, capture.size());
  EXPECT_EQ(description.kinds.at(0).length.at, 3);
  EXPECT_EQ(description.kinds[0].length.add, 6);
  EXPECT_EQ(description.kinds[0].checksum.sum, protocols::described::Sum::crc16_xmodem);
}

TEST(DevicesNew, FindsLinesOfSeveralKindsAndKeys) {
  std::string text = "cut,off\r\n";
  for (int i = 0; i < 20; ++i) {
    const auto line = protocols::checked_line("IIDPT," + std::to_string(i) + ".5,0.3");
    text.append(line.begin(), line.end());
    text += "IMU," + std::to_string(i) + ",1.5,-2\r\n" + std::to_string(i) + ",2,3\r\n";
  }
  Description description;
  const auto findings = guessed(Octets(text.begin(), text.end()), description);
  ASSERT_EQ(findings.kinds.size(), 3U);
  for (const auto& kind : findings.kinds) EXPECT_EQ(kind.frames, 20U) << kind.id.view();
  EXPECT_EQ(findings.summary.counters.skipped_bytes, 9U);

  text.clear();
  for (int i = 0; i < 20; ++i) text += "T=" + std::to_string(10 + i) + " C=3.5 P=1" + std::to_string(i) + "\n";
  const auto keyed = guessed(Octets(text.begin(), text.end()), description);
  EXPECT_EQ(keyed.summary.counters.frames, 20U);
  ASSERT_EQ(description.kinds.at(0).fields.size(), 3U);
  EXPECT_EQ(description.kinds[0].fields[2].key, "P");
}

TEST(DevicesNew, SaysSoWhenNothingComesBack) {
  std::mt19937_64 random(1);  // NOLINT: the same in every run
  Octets noise(20000);
  for (auto& byte : noise) byte = static_cast<std::uint8_t>(random());
  EXPECT_THROW((void)guess_description(noise, std::nullopt), Failure);
  EXPECT_THROW((void)guess_description({}, std::nullopt), Failure);
  EXPECT_THROW((void)guess_description(protocols::Bytes(noise).first(1), std::nullopt), Failure);
}

TEST(DevicesNew, AnyCutOfACaptureGivesAFileThatIsReadOrAWord) {
  const Octets capture = bytes_of_reads(card_recording(6));
  for (std::size_t length = 1; length < capture.size(); length += 37) {
    try {
      (void)config::parse_description(guess_description(protocols::Bytes(capture).first(length), 1.0), "guess");
    } catch (const Failure& failure) {
      EXPECT_NE(std::string(failure.what()), "");
    }
  }
}

}  // namespace
}  // namespace navcal::analysis
