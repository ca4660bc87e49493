// SPDX-License-Identifier: Apache-2.0
#include "gap/data/earth_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "base/angles.h"
#include "gap/data/mission.h"
#include "sim/rotation.h"

namespace navcal::gap {
namespace {

TEST(StatedField, IsReadFromTheMarkOfARecordingAlone) {
  const auto uT = stated_field_uT("simulated field of the Earth: north 19.000, east 0.600, down -44.000 uT");
  ASSERT_TRUE(uT);
  EXPECT_EQ(*uT, (Vector3{19, 0.6, -44}));
  for (const char* text : {"", "dive begins", "simulated field of the Earth: north 19.000, east 0.600",
                           "simulated field of the Earth: north 19, east 0.6, down 44 uT or so",
                           "simulated field of the Earth: north 0, east 0, down 0 uT",
                           "simulated field of the Earth: north 1e9, east 0, down 0 uT",
                           "simulated field of the Earth: north nan, east 0, down 0 uT"}) {
    EXPECT_FALSE(stated_field_uT(text)) << text;
  }
}

/// Readings of a vehicle that circles in a field, with iron, pitching and rolling by so much.
std::vector<CompassReading> circling(const Vector3& earth_uT, const Vector3& iron_uT, double tilt_rad) {
  std::vector<CompassReading> readings;
  for (int i = 0; i < 400; ++i) {
    const Vector3 euler{0.3 * tilt_rad * std::sin(i), tilt_rad * std::cos(2.0 * i), 0.1 * i};
    CompassReading reading;
    reading.roll_rad = euler[0];
    reading.pitch_rad = euler[1];
    reading.field_uT = sim::operator*(sim::transpose(sim::R_world_from_body(euler)), earth_uT);
    for (std::size_t k = 0; k < 3; ++k) reading.field_uT[k] += iron_uT[k];
    readings.push_back(reading);
  }
  return readings;
}

TEST(FittedField, IsThatOfTheReadingsWhateverIronIsAcross) {
  const auto close_to = [](const Vector3& uT, const EarthField& field, double within_uT) {
    EXPECT_EQ(field.source, EarthField::Source::fitted);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(field.north_east_down_uT[i], uT[i], within_uT) << i;
  };
  close_to({12, 0, -50}, fitted_field(circling({12, 0, -50}, {}, 0.3)), 0.02);
  close_to({20, 0, 40}, fitted_field(circling({12, 16, 40}, {2, -1, 0}, 0.3)), 0.2);
  // Vertical iron belongs to the field.
  close_to({20, 0, 41}, fitted_field(circling({20, 0, 40}, {2, -1, 1}, 0)), 0.2);

  auto readings = circling({20, 0, 40}, {}, 0.3);
  readings[7].field_uT = {500, 0, 0};
  close_to({20, 0, 40}, fitted_field(readings), 0.02);
  EXPECT_NE(doubt_of(fitted_field(readings)).find("--field"), std::string::npos);
}

TEST(FittedField, NeedsReadings) {
  EXPECT_EQ(fitted_field({}).source, EarthField::Source::reference);
  EXPECT_EQ(fitted_field(std::vector<CompassReading>(3)).source, EarthField::Source::reference);
}

TEST(ModelField, IsToldWithPlaceAndDate) {
  EarthField field;
  field.place = {59.33 * base::kRadiansPerDegree, -18.07 * base::kRadiansPerDegree, 0};
  field.utc_ns = 1'780'272'000'000'000'000;  // 2026-06-01
  field.set_by_model();
  EXPECT_NE(text_of(field).find("model WMM2025 at 59.33 N 18.07 W on 2026-06-01: north "), std::string::npos)
      << text_of(field);
  EXPECT_FALSE(field.is_extrapolated());
  EXPECT_EQ(doubt_of(field), "");
  field.utc_ns = 1'600'000'000'000'000'000;  // 2020
  EXPECT_TRUE(field.is_extrapolated());
  EXPECT_NE(doubt_of(field).find("2025"), std::string::npos);
}

// An emulated recording is in the model's field there: --field 19.0,0.6,44.0, as once advised, makes a gap.
TEST(ModelField, WhereEmulatedRecordingsLieNoOtherFieldIsAdvised) {
  EarthField field;
  field.place = {37.063 * base::kRadiansPerDegree, -80.628 * base::kRadiansPerDegree, 562};
  field.utc_ns = 1'780'272'000'000'000'000;
  field.set_by_model();
  EXPECT_EQ(doubt_of(field), "");
}

}  // namespace
}  // namespace navcal::gap
