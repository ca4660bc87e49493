// SPDX-License-Identifier: Apache-2.0
// Described devices from bytes to samples: those of the shipped descriptions give what the built-in drivers give,
// bit for bit.
#include <gtest/gtest.h>

#include <bit>

#include "config/described/description_file.h"
#include "instruments/start_up.h"
#include "protocols/checked_line.h"
#include "protocols/imu_card.h"
#include "tests/analysis/described_port.h"
#include "tests/protocols/described_encode.h"

namespace navcal::analysis::described {
namespace {

using instruments::AltimeterSample;
using instruments::CompassSample;
using instruments::DepthSample;
using instruments::DvlSample;
using instruments::ImuSample;
using instruments::ScalarSample;

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
  ASSERT_GT(depths.size(), 900U);
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
  const std::string page = navcal::test::read_file(NAVCAL_SOURCE_DIR "/docs/devices.md");
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

}  // namespace
}  // namespace navcal::analysis::described
