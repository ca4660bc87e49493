// SPDX-License-Identifier: Apache-2.0
#include "protocols/samples_line.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/protocols/samples.h"
#include "tests/protocols/text.h"

namespace navcal::protocols::samples_line {
namespace {

using test::all_at_once;
using test::Buffer;
using test::byte_by_byte;
using test::bytes_of;
using test::Outcome;

constexpr Bounds kAny{-1e9, 1e9};

std::vector<std::string> names_of(std::string_view stream) {
  std::vector<std::string> names;
  const Outcome seen = all_at_once<Scanner>(bytes_of(stream));
  EXPECT_EQ(seen, byte_by_byte<Scanner>(bytes_of(stream)));
  for (const auto& frame : seen.frames) names.emplace_back(frame.id.view());
  return names;
}

using Names = std::vector<std::string>;

TEST(SamplesLine, AFrameIsNamedByItsClass) {
  EXPECT_EQ(
      names_of("{\"class\":\"IMU\"}\n{\"class\": \"DEPTH\",\"depth_m\":3}\r\n{\"time\":1,\"class\":\"DVL\"}\n"),
      (Names{"IMU", "DEPTH", "SAMPLE"}));
  EXPECT_EQ(names_of("{\"class\":\"imu\"}\n{\"class\":7}\n{ \"class\":\"IMU\" }\n"),
            (Names{"SAMPLE", "SAMPLE", "SAMPLE"}));
}

TEST(SamplesLine, ALineThatWasCutCostsNoOther) {
  EXPECT_EQ(names_of("{\"class\":\"IMU\",\"rate{\"class\":\"DVL\"}\n"), (Names{"DVL"}));
  EXPECT_EQ(names_of("{\"class\":\"IMU\",\"rate_rad_s\":[1,\n{\"class\":\"DVL\"}\n"), (Names{"DVL"}));
  const Outcome cut = all_at_once<Scanner>(bytes_of("{\"class\":\"IMU\"\n}\n{}\n"));
  EXPECT_EQ(cut.bad_checksum, 1U);
  EXPECT_EQ(cut.frame_count, 0U) << "an empty object is no sample, and its second byte says so";
}

TEST(SamplesLine, ALineMayHaveAsManyBytesAsTheContractSays) {
  const std::string head = "{\"class\":\"IMU\",\"note\":\"", tail = "\"}\n";
  const auto of_length = [&](std::size_t n) {
    return head + std::string(n - head.size() - tail.size(), 'x') + tail;
  };
  EXPECT_EQ(names_of(of_length(kMaxLength)), (Names{"IMU"}));
  EXPECT_EQ(names_of(of_length(kMaxLength + 1) + "{\"class\":\"DVL\"}\n"), (Names{"DVL"}));
}

TEST(SamplesLine, ReadsMembersOfEachKind) {
  const auto object = Object::parse(bytes_of(
      "{\"a\":-1.5e2 , \"b\":\"x\\u00b0\\u00B5\\ud83d\\ude00\\\"\\n\",\"c\":true,\"d\":null,\"e\":[1,null,-3],"
      "\"f\":[1,2,3],\"g\":[],\"time\":1700000000.123456789}\n"));
  ASSERT_TRUE(object);
  EXPECT_EQ(object->size(), 8U);
  Fields fields(*object);
  EXPECT_EQ(fields.number("a", kAny), -150);
  EXPECT_EQ(fields.text("b"), "x\u00b0\u00b5\U0001F600\"\n");
  EXPECT_EQ(fields.boolean("c"), true);
  EXPECT_EQ(fields.number("d", kAny), std::nullopt);
  EXPECT_EQ(fields.number("absent", kAny), std::nullopt);
  EXPECT_EQ(fields.three("e", kAny), (std::array<std::optional<double>, 3>{1.0, std::nullopt, -3.0}));
  EXPECT_EQ(fields.vector("f", kAny), (std::array<double, 3>{1, 2, 3}));
  EXPECT_EQ(fields.nanoseconds("time"), 1'700'000'000'123'456'789);
  EXPECT_TRUE(fields.all_good());
}

TEST(SamplesLine, AMemberOfAnotherTypeOrOutOfRangeIsRefused) {
  const auto object =
      Object::parse(bytes_of("{\"a\":\"1\",\"b\":[1,2],\"c\":[1,2,null],\"d\":1e9,\"e\":-1,\"f\":1e3,"
                             "\"g\":[1,2,3,4],\"h\":2.5,\"i\":9000000000,\"j\":1e400}\n"));
  ASSERT_TRUE(object);
  const auto is_refused = [&](auto read) {
    Fields fields(*object);
    const bool is_empty = !read(fields);
    return is_empty && !fields.all_good();
  };
  EXPECT_TRUE(is_refused([](Fields& f) { return f.number("a", kAny); }));
  EXPECT_TRUE(is_refused([](Fields& f) { return f.vector("b", kAny); }));
  EXPECT_TRUE(is_refused([](Fields& f) { return f.vector("c", kAny); }));
  EXPECT_TRUE(is_refused([](Fields& f) { return f.number("d", {0, 10}); }));
  EXPECT_TRUE(is_refused([](Fields& f) { return f.nanoseconds("e"); }));
  EXPECT_TRUE(is_refused([](Fields& f) { return f.nanoseconds("f"); })) << "an exponent";
  EXPECT_TRUE(is_refused([](Fields& f) { return f.nanoseconds("i"); }));
  EXPECT_TRUE(is_refused([](Fields& f) { return f.integer("h", 255); }));
  EXPECT_TRUE(is_refused([](Fields& f) { return f.number("j", kAny); }));
  Fields fields(*object);
  (void)fields.three("g", kAny);
  EXPECT_FALSE(fields.all_good());
}

TEST(SamplesLine, WhatIsNotOneFlatObjectIsRefused) {
  for (const char* const text : {"",
                                 "{",
                                 "{}x",
                                 "[1]",
                                 "{\"a\"}",
                                 "{\"a\":}",
                                 "{\"a\":1,}",
                                 "{\"a\":01}",
                                 "{\"a\":.5}",
                                 "{\"a\":1.}",
                                 "{\"a\":+1}",
                                 "{\"a\":nan}",
                                 "{\"a\":tru}",
                                 "{\"a\":\"\\x\"}",
                                 "{\"a\":\"\\u12g4\"}",
                                 "{\"a\":\"b}",
                                 "{\"a\":[1,]}",
                                 "{\"a\":[1}",
                                 "{\"a\":{}}",
                                 "{\"a\":[[1]]}",
                                 "{\"a\":1e}",
                                 "{a:1}",
                                 "{\"a\":\"\x01\"}"}) {
    EXPECT_FALSE(Object::parse(bytes_of(text))) << text;
  }
  std::string many = "{";
  for (std::size_t i = 0; i <= Object::kMostMembers; ++i) many += (i == 0 ? "\"a\":1" : ",\"a\":1");
  EXPECT_FALSE(Object::parse(bytes_of(many + "}")));
}

TEST(SamplesLine, WhatIsWrittenIsRead) {
  const std::string line = LineWriter("SENSOR")
                               .seconds("time", 1'700'000'000'000'000'001)
                               .text("quantity", "oxygen {\"x\"} \\ \t")
                               .text("unit", "\u00b5mol/l")
                               .number("value", 0.1)
                               .number("std", std::nan(""))
                               .finish();
  const auto seen = all_at_once<Scanner>(bytes_of(line));
  ASSERT_EQ(seen.frames.size(), 1U);
  const auto object = Object::parse(bytes_of(line));
  ASSERT_TRUE(object);
  Fields fields(*object);
  EXPECT_EQ(fields.nanoseconds("time"), 1'700'000'000'000'000'001);
  EXPECT_EQ(fields.text("quantity"), "oxygen {\"x\"} \\ \t");
  EXPECT_EQ(fields.text("unit"), "\u00b5mol/l");
  EXPECT_EQ(fields.number("value", kAny), 0.1);
  EXPECT_EQ(object->find("std"), nullptr);
  EXPECT_NE(LineWriter("SENSOR")
                .text("unit", "a\xFFz\xC2\xB5\xE0\x80\x80")
                .finish()
                .find("a\xEF\xBF\xBDz\xC2\xB5\xEF\xBF\xBD"),
            std::string::npos)
      << "what is no UTF-8 is replaced";
  test::Random random(5);
  for (int i = 0; i < 500; ++i) EXPECT_TRUE(Object::parse(bytes_of(test::random_samples_line(random))));
}

TEST(SamplesLine, TheDivisionIntoReadsMakesNoDifference) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    test::Random random(seed);
    const Buffer stream = test::mixture(random, test::random_frame<Scanner>, 40);
    EXPECT_EQ(all_at_once<Scanner>(stream), byte_by_byte<Scanner>(stream));
  }
}

}  // namespace
}  // namespace navcal::protocols::samples_line
