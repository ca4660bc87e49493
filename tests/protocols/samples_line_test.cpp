// SPDX-License-Identifier: Apache-2.0
#include "protocols/samples_line.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

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

TEST(SamplesLine, TheSecondByteDecides) {
  for (const char* const text : {"{}", "{1", "{\n"}) {
    const Outcome seen = all_at_once<Scanner>(bytes_of(text));
    EXPECT_EQ(seen.held, 0U) << text;
    EXPECT_EQ(seen.skipped_bytes, 2U) << text;
  }
  EXPECT_EQ(all_at_once<Scanner>(bytes_of("{\"")).held, 2U);
}

TEST(SamplesLine, EveryClassOfTheContractIsAName) {
  for (const std::string name : {"COMPASS", "IMU", "GPS", "MOTOR", "ALTIMETER", "POWER", "DVL", "DEPTH", "SENSOR",
                                 "A", "Z", "ABCDEFGHIJKLMNOP"}) {
    EXPECT_EQ(names_of("{\"class\":\"" + name + "\"}\n"), (Names{name}));
  }
  for (const std::string name : {"", "ABCDEFGHIJKLMNOPQ", "A B", "A[", "@A", "IMU2"})
    EXPECT_EQ(names_of("{\"class\":\"" + name + "\"}\n"), (Names{"SAMPLE"}));
}

/// A text as it comes out of a line that it was written into.
std::string written_and_read(std::string_view text) {
  const std::string line = LineWriter("SENSOR").text("t", text).finish();
  const auto object = Object::parse(bytes_of(line));
  EXPECT_TRUE(object) << line;
  return object ? Fields(*object).text("t").value_or("none") : "none";
}

TEST(SamplesLine, TextOfEachLengthOfUtf8ComesBack) {
  // The first and the last code point of each length, and those beside the surrogates.
  for (const std::string_view text :
       {"\x01", "\x7F", "\xC2\x80", "\xDF\xBF", "\xE0\xA0\x80", "\xED\x9F\xBF", "\xEE\x80\x80", "\xEF\xBF\xBF",
        "\xE2\x82\xAC", "\xF0\x90\x80\x80", "\xF3\xBF\xBF\xBF", "\xF4\x8F\xBF\xBF"}) {
    const std::string within = "a" + std::string(text) + "z";
    EXPECT_EQ(written_and_read(within), within);
  }
}

TEST(SamplesLine, WhatIsNoUtf8IsReplacedByteByByte) {
  // Too long, a surrogate, beyond the last code point, cut, and a byte that never begins one.
  for (const std::string_view text :
       {"\xC0\x80", "\xC1\xBF", "\xE0\x9F\xBF", "\xED\xA0\x80", "\xED\xBF\xBF", "\xF0\x8F\xBF\xBF",
        "\xF4\x90\x80\x80", "\xF5\x80\x80\x80", "\xC2", "\xE2\x82", "\x80", "\xFF"}) {
    std::string replaced = "a";
    for (std::size_t i = 0; i < text.size(); ++i) replaced += "\xEF\xBF\xBD";
    EXPECT_EQ(written_and_read("a" + std::string(text) + "z"), replaced + "z");
  }
}

std::string unescaped(const std::string& escaped) {
  const std::string line = "{\"t\":\"" + escaped + "\"}";
  const auto object = Object::parse(bytes_of(line));
  EXPECT_TRUE(object) << line;
  return object ? Fields(*object).text("t").value_or("none") : "none";
}

TEST(SamplesLine, EscapesOfJson) {
  EXPECT_EQ(unescaped(R"(\"\\\/\b\f\n\r\tx)"), "\"\\/\b\f\n\r\tx");
  EXPECT_EQ(unescaped(R"(\u0041\u00e9\u07FF\u0800\uFFFFx)"), "A\xC3\xA9\xDF\xBF\xE0\xA0\x80\xEF\xBF\xBFx");
  EXPECT_EQ(unescaped(R"(\uD800\uDC00x\uDBFF\uDFFFy)"), "\xF0\x90\x80\x80x\xF4\x8F\xBF\xBFy");
}

TEST(SamplesLine, HalfAPairOfSurrogatesIsReplaced) {
  const std::string none = "\xEF\xBF\xBD";
  EXPECT_EQ(unescaped(R"(\uD800x)"), none + "x");
  EXPECT_EQ(unescaped(R"(\uDC00x)"), none + "x");
  EXPECT_EQ(unescaped(R"(\uDFFF\uD800)"), none + none);
  EXPECT_EQ(unescaped(R"(\uD800\u0041)"), none + "A") << "what follows is read";
  EXPECT_EQ(unescaped(R"(\uD800\uE000)"), none + "\xEE\x80\x80");
  EXPECT_EQ(unescaped(R"(\uD800\n)"), none + "\n");
}

TEST(SamplesLine, ThreeNumbersOfWhichSomeAreAbsentComeBack) {
  const std::array<std::optional<double>, 3> some{1.5, std::nullopt, -3.0};
  const std::string line = LineWriter("DVL")
                               .three("some", some)
                               .three("none", {})
                               .three("nan", {{std::nan(""), 2.0, 3.0}})
                               .vector("all", {1, -2, 3e-9})
                               .vector("lost", {1, std::nan(""), 3})
                               .boolean("yes", true)
                               .boolean("no", false)
                               .seconds("before", -1)
                               .finish();
  const auto object = Object::parse(bytes_of(line));
  ASSERT_TRUE(object) << line;
  Fields fields(*object);
  EXPECT_EQ(fields.three("some", kAny), some);
  EXPECT_EQ(fields.three("none", kAny), (std::array<std::optional<double>, 3>{}));
  EXPECT_EQ(fields.three("nan", kAny), (std::array<std::optional<double>, 3>{std::nullopt, 2.0, 3.0}));
  EXPECT_EQ(fields.vector("all", kAny), (std::array<double, 3>{1, -2, 3e-9}));
  EXPECT_EQ(object->find("lost"), nullptr) << "a vector is whole or absent";
  EXPECT_EQ(fields.boolean("yes"), true);
  EXPECT_EQ(fields.boolean("no"), false);
  EXPECT_EQ(object->find("before"), nullptr);
  EXPECT_TRUE(fields.all_good());
}

TEST(SamplesLine, TimesOfAnyNumberOfDecimals) {
  const auto nanoseconds = [](const std::string& text) {
    const std::string line = "{\"t\":" + text + "}";
    const auto object = Object::parse(bytes_of(line));
    return object ? Fields(*object).nanoseconds("t") : std::nullopt;
  };
  EXPECT_EQ(nanoseconds("0"), 0);
  EXPECT_EQ(nanoseconds("7"), 7'000'000'000);
  EXPECT_EQ(nanoseconds("7.5"), 7'500'000'000);
  EXPECT_EQ(nanoseconds("7.123456789"), 7'123'456'789);
  EXPECT_EQ(nanoseconds("7.1234567899"), 7'123'456'789) << "finer than a nanosecond is cut";
  EXPECT_EQ(nanoseconds("8999999999.999999999"), 8'999'999'999'999'999'999);
  EXPECT_FALSE(nanoseconds("10000000000"));
}

TEST(SamplesLine, BoundsBelongToTheRange) {
  const std::string line = R"({"low":-2,"high":3,"whole":255})";
  const auto object = Object::parse(bytes_of(line));
  ASSERT_TRUE(object);
  Fields fields(*object);
  EXPECT_EQ(fields.number("low", {-2, 3}), -2);
  EXPECT_EQ(fields.number("high", {-2, 3}), 3);
  EXPECT_EQ(fields.integer("whole", 255), 255U);
  EXPECT_TRUE(fields.all_good());
  EXPECT_FALSE(fields.integer("whole", 254));
  EXPECT_FALSE(fields.all_good());
}

TEST(SamplesLine, ABraceWithinATextIsNoOtherLine) {
  EXPECT_EQ(names_of("{\"class\":\"SENSOR\",\"note\":\"a{b { }\"}\n"), (Names{"SENSOR"}));
  EXPECT_EQ(names_of("{\"class\":\"SENSOR\",\"note\":\"{\n{\"class\":\"IMU\"}\n"), (Names{"IMU"}));
}

TEST(SamplesLine, ANumberThatMayBeAbsent) {
  const std::string line =
      LineWriter("X").number("there", std::optional(2.5)).number("not", std::nullopt).finish();
  EXPECT_EQ(line, "{\"class\":\"X\",\"there\":2.5}\n");
}

}  // namespace
}  // namespace navcal::protocols::samples_line
