// SPDX-License-Identifier: Apache-2.0
#include "analysis/decode_fields.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <random>

#include "base/failure.h"

namespace navcal::cli {
namespace {

/// Output of `write(fields)`, in either format.
template <class Write>
std::string written(analysis::FieldWriter::Format format, Write write) {
  std::array<int, 2> ends{};
  EXPECT_EQ(::pipe(ends.data()), 0);
  base::Output output(ends[1], "pipe");
  analysis::FieldWriter fields(output, format);
  fields.begin_frame("test", {protocols::FrameId("ID"), 7, {}});
  write(fields);
  fields.end_frame();
  output.flush();
  ::close(ends[1]);
  std::string text(65536, '\0');
  const ssize_t n = ::read(ends[0], text.data(), text.size());
  ::close(ends[0]);
  text.resize(static_cast<std::size_t>(std::max<ssize_t>(n, 0)));
  return text;
}

template <class Write>
nlohmann::json json_of(Write write) {
  return nlohmann::json::parse(written(analysis::FieldWriter::Format::json, write));
}

std::string fixed(double value, int decimals) {
  return json_of([&](analysis::FieldWriter& fields) { fields.number("x", value, decimals); })["x"].dump();
}

TEST(FieldWriter, NumbersAreRoundedAndZerosAtTheEndLeftOut) {
  EXPECT_EQ(fixed(86.44, 3), "86.44");
  EXPECT_EQ(fixed(-0.05, 1), "-0.1");
  EXPECT_EQ(fixed(0, 3), "0");
  EXPECT_EQ(fixed(-0.0001, 3), "0") << "no minus before a zero";
  EXPECT_EQ(fixed(100, 3), "100");
  EXPECT_EQ(fixed(0.001, 3), "0.001");
  EXPECT_EQ(fixed(-179.999999999, 9), "-179.999999999");
  EXPECT_EQ(fixed(1e300, 3), "1e+300");
}

TEST(FieldWriter, RoundedNumbersAreTheNearest) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-180, 180);
  for (int i = 0; i < 2000; ++i) {
    const double value = uniform(random);
    EXPECT_NEAR(std::stod(fixed(value, 9)), value, 0.5000001e-9);
  }
}

TEST(FieldWriter, ExactNumbersKeepTheirDecimals) {
  const auto text = [](protocols::nmea::Decimal number) {
    return written(analysis::FieldWriter::Format::text,
                   [&](analysis::FieldWriter& fields) { fields.number("x", number); });
  };
  EXPECT_NE(text({110, 2}).find("x=1.10\n"), std::string::npos);
  EXPECT_NE(text({-5, 3}).find("x=-0.005\n"), std::string::npos);
  EXPECT_NE(text({14223, 0}).find("x=14223\n"), std::string::npos);
  EXPECT_NE(text({0, 1}).find("x=0.0\n"), std::string::npos);
}

TEST(FieldWriter, AnyBytesMakeValidJson) {
  std::string all;
  for (int c = 0; c < 256; ++c) all += static_cast<char>(c);
  const auto json = json_of([&](analysis::FieldWriter& fields) { fields.text("x", all); });
  const std::string got = json["x"];
  EXPECT_EQ(got.substr(0, 128), all.substr(0, 128));
}

TEST(FieldWriter, WhatIsAbsentIsNullForProgramsAndLeftOutForPeople) {
  const auto write = [](analysis::FieldWriter& fields) {
    fields.number("a", std::optional<double>{}, 3);
    fields.number("b", std::optional<std::uint8_t>{});
    fields.letter("c", '\0');
    fields.number("d", 5);
  };
  const auto json = json_of(write);
  EXPECT_TRUE(json["a"].is_null() && json["b"].is_null() && json["c"].is_null());
  EXPECT_EQ(written(analysis::FieldWriter::Format::text, write), "           7    0 ID       d=5\n");
}

TEST(FieldWriter, ListsAndObjectsNest) {
  const auto json = json_of([](analysis::FieldWriter& fields) {
    fields.begin_list("list");
    for (int i = 0; i < 2; ++i) {
      fields.begin_object();
      fields.number("i", i);
      fields.flag("even", i % 2 == 0);
      fields.end_object();
    }
    fields.null({});
    fields.end_list();
    fields.begin_list("empty");
    fields.end_list();
    fields.number("after", 1);
  });
  EXPECT_EQ(json["list"].dump(), R"([{"even":true,"i":0},{"even":false,"i":1},null])");
  EXPECT_EQ(json["empty"].dump(), "[]");
  EXPECT_EQ(json["after"], 1);
}

TEST(FieldWriter, TimesAreIso8601) {
  const auto time = [](std::uint32_t nanosecond) -> std::string {
    return json_of([&](analysis::FieldWriter& fields) {
      fields.time("t", {2026, 1, 2}, {3, 4, 60, nanosecond});
    })["t"];
  };
  EXPECT_EQ(time(0), "2026-01-02T03:04:60Z");
  EXPECT_EQ(time(250'000'000), "2026-01-02T03:04:60.250Z");
  EXPECT_EQ(time(1000), "2026-01-02T03:04:60.000001Z");
  EXPECT_EQ(time(1), "2026-01-02T03:04:60.000000001Z");
}

TEST(Output, MoreThanTheBufferHoldsGoesThroughWhole) {
  std::FILE* const file = std::tmpfile();
  ASSERT_NE(file, nullptr);
  std::string text;
  for (int i = 0; i < 200'000; ++i) text += std::to_string(i);
  base::Output output(::fileno(file), "file");
  output.append(text);
  for (const char c : text) output.append(c);
  output.flush();
  std::string got(3 * text.size(), '\0');
  got.resize(static_cast<std::size_t>(::pread(::fileno(file), got.data(), got.size(), 0)));
  std::fclose(file);
  EXPECT_EQ(got, text + text);
}

TEST(Output, SaysWhyItCannotWrite) {
  base::Output output(-1, "standard output");
  output.append("x");
  try {
    output.flush();
    FAIL();
  } catch (const base::Failure& failure) {
    EXPECT_EQ(failure.status(), base::Exit::failed);
    EXPECT_STREQ(failure.what(), "standard output: cannot write: Bad file descriptor");
  }
}

}  // namespace
}  // namespace navcal::cli
