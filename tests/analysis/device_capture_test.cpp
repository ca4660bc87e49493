// SPDX-License-Identifier: Apache-2.0
// What `navcal devices check` and `navcal devices new` find in captures.
#include <gtest/gtest.h>

#include "analysis/device_check.h"
#include "analysis/device_guess.h"
#include "base/failure.h"
#include "config/described/description_file.h"
#include "protocols/checked_line.h"
#include "tests/analysis/described_port.h"
#include "tests/protocols/described_encode.h"

namespace navcal::analysis::described {
namespace {

using protocols::described::Description;

/// All of a capture in one piece.
DeviceFindings checked(const Description& description, const Octets& capture) {
  bool given = false;
  return check_device(description, [&] {
    return std::exchange(given, true) ? TimedBytes{} : TimedBytes{capture, std::nullopt};
  });
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
  kind.constants = {{2, "\x80"}};
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
  EXPECT_THROW((void)guess_description(noise, std::nullopt), base::Failure);
  EXPECT_THROW((void)guess_description({}, std::nullopt), base::Failure);
  EXPECT_THROW((void)guess_description(protocols::Bytes(noise).first(1), std::nullopt), base::Failure);
}

TEST(DevicesNew, AnyCutOfACaptureGivesAFileThatIsReadOrAWord) {
  const Octets capture = bytes_of_reads(card_recording(6));
  for (std::size_t length = 1; length < capture.size(); length += 37) {
    try {
      (void)config::parse_description(guess_description(protocols::Bytes(capture).first(length), 1.0), "guess");
    } catch (const base::Failure& failure) {
      EXPECT_NE(std::string(failure.what()), "");
    }
  }
}

}  // namespace
}  // namespace navcal::analysis::described
