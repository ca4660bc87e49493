// SPDX-License-Identifier: Apache-2.0
#include "protocols/motor_card.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/protocols/samples.h"
#include "tests/protocols/stream.h"
#include "tests/protocols/text.h"

namespace navcal::protocols::test {
namespace {

Outcome parsed_card(std::string_view text) { return all_at_once<motor_card::Scanner>(bytes_of(text)); }

TEST(MotorCard, WhatIsEncodedIsDecoded) {
  Random random(1);
  for (int i = 0; i < 2000; ++i) {
    const motor_card::Status status = random_status(random);
    EXPECT_EQ(motor_card::decode_status(motor_card::encode_status(status)), status);
    const motor_card::Command command{static_cast<std::int32_t>(below(random, 4001)) - 2000,
                                      {printed(random, 25, 10), printed(random, 25, 10), printed(random, 25, 10)}};
    EXPECT_EQ(motor_card::decode_command(motor_card::encode_command(command)), command);
  }
}

TEST(MotorCard, StatusByteForByte) {
  const motor_card::Status status{17, 1500, 1487, {-2.5, 0.0, 12.0}, 3.25};
  const std::string text = line("MCS,17,1500,1487,-2.5,0.0,12.0,3.25");
  EXPECT_EQ(text_of(motor_card::encode_status(status)), text);
  EXPECT_EQ(motor_card::decode_status(bytes_of(text)), status);
  const char* const digits = "0123456789ABCDEF";
  EXPECT_NE(std::string(digits).find(text[text.size() - 3]), std::string::npos) << "upper case";
}

TEST(MotorCard, AnyFieldOfAStatusMayBeEmpty) {
  EXPECT_EQ(motor_card::decode_status(bytes_of(line("MCS,,,,,,,"))), motor_card::Status{});
  const auto status = motor_card::decode_status(bytes_of(line("MCS,255,,-12,,1.5,,0.05")));
  ASSERT_TRUE(status);
  EXPECT_EQ(*status, (motor_card::Status{255, std::nullopt, -12, {std::nullopt, 1.5, std::nullopt}, 0.05}));
}

TEST(MotorCard, AStatusThatCannotBe) {
  for (const std::string_view body :
       {"MCS,256,1,1,1.0,1.0,1.0,1.0", "MCS,-1,1,1,1.0,1.0,1.0,1.0", "MCS,1,1.5,1,1.0,1.0,1.0,1.0",
        "MCS,1,1,1,1.0,1.0,1.0", "MCS,1,1,1,1.0,1.0,1.0,1.0,", "MCS,1,1,1,1e1,1.0,1.0,1.0",
        "MCS,1,1,1,nan,1.0,1.0,1.0", "MCS,1,1,1,1.0 ,1.0,1.0,1.0", "MCS,1,99999999999,1,1.0,1.0,1.0,1.0", "MCS,",
        "MCC,1,1.0,1.0,1.0"}) {
    EXPECT_FALSE(motor_card::decode_status(bytes_of(line(body)))) << body;
  }
  EXPECT_FALSE(motor_card::decode_status({}));
}

TEST(MotorCard, CommandByteForByte) {
  EXPECT_EQ(text_of(motor_card::encode_command({-300, {25.0, -12.5, 0.04}})), line("MCC,-300,25.0,-12.5,0.0"));
}

TEST(MotorCard, ACommandIsWhole) {
  for (const std::string_view body :
       {"MCC,,1.0,1.0,1.0", "MCC,1,,1.0,1.0", "MCC,1,1.0,1.0", "MCC,1,1.0,1.0,1.0,1.0", "MCC,1.5,1.0,1.0,1.0"}) {
    EXPECT_FALSE(motor_card::decode_command(bytes_of(line(body)))) << body;
  }
}

TEST(MotorCard, OnlyItsOwnLinesAreFrames) {
  const Outcome seen = parsed_card(line("MCS,1,2,3,4.0,5.0,6.0,7.00") + line("GPGGA,1") +
                                   line("MCC,1,2.0,3.0,4.0") + line("MCX,1") + line("MCSX,1") + line("C1.0"));
  ASSERT_EQ(seen.frames.size(), 2U);
  EXPECT_EQ(seen.frames[0].id, motor_card::kMcs);
  EXPECT_EQ(seen.frames[1].id, motor_card::kMcc);
}

TEST(MotorCard, ADamagedLineIsCountedAndCostsOnlyItself) {
  const std::string good = line("MCS,1,2,3,4.0,5.0,6.0,7.00");
  std::string bad = good;
  bad[8] = '\x01';
  const Outcome seen = parsed_card(bad + good);
  EXPECT_EQ(seen.frames.size(), 1U);
  EXPECT_EQ(seen.bad_checksum, 1U);
  EXPECT_EQ(seen.skipped_bytes, bad.size());
}

TEST(MotorCard, TheFourthByteDecides) {
  EXPECT_EQ(parsed_card("$MCX").held, 0U);
  EXPECT_EQ(parsed_card("$MCSX").held, 0U);
  EXPECT_EQ(parsed_card("$MCS").held, 4U);
  EXPECT_EQ(parsed_card("$MCC,").held, 5U);
}

}  // namespace
}  // namespace navcal::protocols::test
