// SPDX-License-Identifier: Apache-2.0
#include "daemon/json_text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>

namespace navcal::daemon {
namespace {

std::string fixed(double value, int decimals) {
  std::string out;
  append_fixed(out, value, decimals);
  return out;
}

std::string shortest(double value, int decimals) {
  std::string out;
  append_shortest(out, value, decimals);
  return out;
}

std::string utc(std::int64_t ns, int decimals) {
  std::string out;
  append_utc(out, ns, decimals);
  return out;
}

TEST(JsonText, QuotesAnyBytesAsValidJson) {
  std::string all;
  for (int i = 0; i < 256; ++i) all += static_cast<char>(i);
  std::string out;
  append_quoted(out, all);
  const auto value = nlohmann::json::parse(out, nullptr, false);
  ASSERT_TRUE(value.is_string()) << out;
  EXPECT_EQ(out.find('\n'), std::string::npos) << "a newline would end the report";
}

TEST(JsonText, RoundedNumbersAreWithinHalfAPlaceForAnyValue) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> value(-1e6, 1e6);
  for (int i = 0; i < 20'000; ++i) {
    const double v = value(random);
    for (int decimals = 0; decimals <= 9; ++decimals) {
      const double half = 0.5000001 * std::pow(10.0, -decimals) + 1e-9;
      EXPECT_NEAR(std::stod(fixed(v, decimals)), v, half);
      EXPECT_NEAR(std::stod(shortest(v, decimals)), v, half);
    }
  }
}

TEST(JsonText, NumbersNearZeroAndTheirSigns) {
  EXPECT_EQ(fixed(0, 4), "0.0000");
  EXPECT_EQ(fixed(-0.0, 4), "0.0000");
  EXPECT_EQ(fixed(-0.00001, 4), "0.0000");
  EXPECT_EQ(fixed(-0.25, 4), "-0.2500");
  EXPECT_EQ(fixed(1234.56, 4), "1234.5600");
  EXPECT_EQ(shortest(12.330000000000002, 6), "12.33");
  EXPECT_EQ(shortest(-18.43, 6), "-18.43");
  EXPECT_EQ(shortest(100, 6), "100");
  EXPECT_EQ(fixed(7, 0), "7");
}

TEST(JsonText, NumbersThatDoNotFitStayValidJson) {
  EXPECT_EQ(fixed(std::numeric_limits<double>::quiet_NaN(), 3), "null");
  EXPECT_EQ(fixed(std::numeric_limits<double>::infinity(), 3), "null");
  EXPECT_TRUE(nlohmann::json::parse(fixed(-1e300, 9), nullptr, false).is_number());
}

TEST(JsonText, TimesAgreeWithTheCLibraryOverFourCenturies) {
  std::mt19937_64 random(2);
  std::uniform_int_distribution<std::int64_t> second(-6'000'000'000, 7'000'000'000);
  for (int i = 0; i < 20'000; ++i) {
    const time_t t = second(random);
    std::tm parts{};
    ASSERT_NE(gmtime_r(&t, &parts), nullptr);
    char text[64];
    ASSERT_GT(std::strftime(text, sizeof text, "\"%Y-%m-%dT%H:%M:%SZ\"", &parts), 0U);
    EXPECT_EQ(utc(t * 1'000'000'000, 0), text);
  }
}

TEST(JsonText, TimesRoundDownAndKeepTheirPlaces) {
  constexpr std::int64_t kFirstOfMarch2026_s = 1'772'323'200;
  constexpr std::int64_t kNs = 1'000'000'000;
  EXPECT_EQ(utc(kFirstOfMarch2026_s * kNs + 100'000'000, 3), "\"2026-03-01T00:00:00.100Z\"");
  EXPECT_EQ(utc(kFirstOfMarch2026_s * kNs + 999'999'999, 6), "\"2026-03-01T00:00:00.999999Z\"");
  EXPECT_EQ(utc(-1, 9), "\"1969-12-31T23:59:59.999999999Z\"");
}

}  // namespace
}  // namespace navcal::daemon
