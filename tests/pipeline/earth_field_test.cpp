// SPDX-License-Identifier: Apache-2.0
#include "pipeline/earth_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/angles.h"
#include "base/world_magnetic_model.h"

namespace navcal::pipeline {
namespace {

constexpr std::int64_t kJune2026_ns = 1'780'272'000'000'000'000;
using Source = EarthField::Source;

instruments::GpsSample fix_at(double latitude_deg, double longitude_deg, std::int64_t time_ns = kJune2026_ns) {
  instruments::GpsSample fix;
  fix.fix = instruments::Fix::fix_2d;
  fix.latitude_rad = latitude_deg * base::kRadiansPerDegree;
  fix.longitude_rad = longitude_deg * base::kRadiansPerDegree;
  fix.time_utc_ns = time_ns;
  return fix;
}

TEST(EarthFieldWatch, AFixGivesTheFieldOfTheModel) {
  EarthFieldWatch watch({});
  EXPECT_EQ(watch.field().declination_source, Source::none);
  ASSERT_TRUE(watch.take(fix_at(59.33, 18.07)));
  const auto model =
      base::world_magnetic_field({59.33 * base::kRadiansPerDegree, 18.07 * base::kRadiansPerDegree, 0}, 2026.4137);
  EXPECT_NEAR(watch.field().declination_rad, model.declination_rad(), 1e-5);
  EXPECT_NEAR(watch.field().size_uT, model.total_uT(), 1e-3);
  EXPECT_NEAR(watch.field().dip_rad, model.dip_rad(), 1e-5);
  EXPECT_EQ(watch.field().size_source, Source::model);
}

TEST(EarthFieldWatch, WhatIsConfiguredStays) {
  config::EnvironmentSettings settings;
  settings.declination_rad = 0.1;
  EarthFieldWatch watch(settings);
  ASSERT_TRUE(watch.take(fix_at(0, 0)));
  EXPECT_EQ(watch.field().declination_rad, 0.1);
  EXPECT_EQ(watch.field().declination_source, Source::configuration);
  EXPECT_EQ(watch.field().size_source, Source::model);

  settings.field_uT = 50;
  EarthFieldWatch complete(settings);
  EXPECT_FALSE(complete.take(fix_at(0, 0)));
  EXPECT_EQ(complete.field().size_uT, 50);

  config::EnvironmentSettings without_model;
  without_model.model = false;
  EarthFieldWatch off(without_model);
  EXPECT_FALSE(off.take(fix_at(0, 0)));
  EXPECT_EQ(off.field().declination_source, Source::none);
}

TEST(EarthFieldWatch, FollowsAVehicleThatMovesFar) {
  EarthFieldWatch watch({});
  ASSERT_TRUE(watch.take(fix_at(60, 179.99)));
  EXPECT_FALSE(watch.take(fix_at(60.05, 179.99))) << "6 km";
  EXPECT_FALSE(watch.take(fix_at(60, -179.99))) << "1 km, across the date line";
  EXPECT_TRUE(watch.take(fix_at(60.2, 179.99))) << "22 km";
  EXPECT_FALSE(watch.take(fix_at(60.2, 179.99, kJune2026_ns + 86'400'000'000'000)));
  EXPECT_TRUE(watch.take(fix_at(60.2, 179.99, kJune2026_ns + 40 * 86'400'000'000'000)));
}

TEST(EarthFieldWatch, FixesThatSayTooLittleSayNothing) {
  EarthFieldWatch watch({});
  auto none = fix_at(10, 10);
  none.fix = instruments::Fix::none;
  EXPECT_FALSE(watch.take(none));
  auto timeless = fix_at(10, 10);
  timeless.time_utc_ns.reset();
  EXPECT_FALSE(watch.take(timeless));
  EXPECT_FALSE(watch.take(fix_at(10, 10, 1'069'000'000'000'000'000))) << "2003: the model does not cover it";
  EXPECT_FALSE(watch.place());
}

TEST(EarthFieldWatch, GoesOnWhereItWas) {
  EarthFieldWatch watch({}), other({});
  ASSERT_TRUE(watch.take(fix_at(-33, 151)));
  ASSERT_TRUE(other.go_on_at(*watch.place()));
  EXPECT_EQ(other.field().declination_rad, watch.field().declination_rad);
}

TEST(EarthField, WordsNameTheSource) {
  config::EnvironmentSettings settings;
  EXPECT_EQ(words_for(EarthField(settings)), "the declination is not known");
  settings.declination_rad = -8 * base::kRadiansPerDegree;
  EXPECT_EQ(words_for(EarthField(settings)), "declination 8.00 deg west as configured");
  EarthFieldWatch watch(settings);
  ASSERT_TRUE(watch.take(fix_at(37, -80)));
  const std::string words = words_for(watch.field());
  EXPECT_NE(words.find("by the World Magnetic Model"), std::string::npos) << words;
}

}  // namespace
}  // namespace navcal::pipeline
