// SPDX-License-Identifier: Apache-2.0
#include "base/world_magnetic_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

namespace navcal::base {
namespace {

constexpr double kRad = std::numbers::pi / 180;

struct PublishedRow {
  double year, height_km, latitude_deg, longitude_deg, north_nT, east_nT, down_nT, horizontal_nT, total_nT,
      dip_deg, declination_deg;
};

std::vector<PublishedRow> published_rows() {
  std::ifstream file(NAVCAL_SOURCE_DIR "/fixtures/world_magnetic_model/wmm2025_test_values.csv");
  std::vector<PublishedRow> rows;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line.front() == '#' || line.front() == 'y') continue;
    std::vector<double> v;
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) v.push_back(std::stod(cell));
    rows.push_back(
        {v.at(0), v.at(1), v.at(2), v.at(3), v.at(4), v.at(5), v.at(6), v.at(7), v.at(8), v.at(9), v.at(10)});
  }
  return rows;
}

MagneticField field_at(double latitude_deg, double longitude_deg, double height_km, double year) {
  return world_magnetic_field({latitude_deg * kRad, longitude_deg * kRad, height_km * 1e3}, year);
}

TEST(WorldMagneticModel, GivesThePublishedTestValues) {
  const auto rows = published_rows();
  ASSERT_EQ(rows.size(), 100U);
  for (const PublishedRow& row : rows) {
    const MagneticField field = field_at(row.latitude_deg, row.longitude_deg, row.height_km, row.year);
    const Eigen::Vector3d nT = field.north_east_down_uT * 1e3;
    const std::string place = testing::PrintToString(row.latitude_deg) + ", " +
                              testing::PrintToString(row.longitude_deg) + ", " + testing::PrintToString(row.year);
    constexpr double kDigit_nT = 0.6e-6, kDigit_deg = 0.00501;  // half of the last digit given
    // The published north components turn the vector by an angle that was rounded to some 1e-8 rad.
    constexpr double kRotation_nT = 1e-3;
    EXPECT_NEAR(nT.y(), row.east_nT, kDigit_nT) << place;
    EXPECT_NEAR(nT.z(), row.down_nT, 5 * kDigit_nT) << place;
    EXPECT_NEAR(nT.x(), row.north_nT, kRotation_nT) << place;
    EXPECT_NEAR(field.horizontal_uT() * 1e3, row.horizontal_nT, kRotation_nT) << place;
    EXPECT_NEAR(field.total_uT() * 1e3, row.total_nT, kRotation_nT) << place;
    EXPECT_NEAR(field.dip_rad() / kRad, row.dip_deg, kDigit_deg) << place;
    EXPECT_NEAR(field.declination_rad() / kRad, row.declination_deg, kDigit_deg) << place;
  }
}

TEST(WorldMagneticModel, IsTheGradientOfAPotential) {
  // No current flows in air: the curl of the field is zero. Down and north by central differences on the meridian.
  constexpr double kStep_m = 1000;
  for (const double latitude_deg : {-70.0, -20.0, 0.0, 45.0, 80.0}) {
    const double sine = std::sin(latitude_deg * kRad);
    const double meridian_radius_m = 6335439.327 / std::pow(1 - 0.00669437999 * sine * sine, 1.5);  // WGS 84
    const auto at = [&](double north_m, double up_m) {
      return field_at(latitude_deg + north_m / meridian_radius_m / kRad, 30, up_m / 1e3, 2026);
    };
    const double down_by_north =
        (at(kStep_m, 0).north_east_down_uT.z() - at(-kStep_m, 0).north_east_down_uT.z()) / (2 * kStep_m);
    const double north_by_down =
        (at(0, -kStep_m).north_east_down_uT.x() - at(0, kStep_m).north_east_down_uT.x()) / (2 * kStep_m);
    const double curvature = at(0, 0).north_east_down_uT.x() / meridian_radius_m;
    EXPECT_NEAR(down_by_north, north_by_down - curvature, 1e-10) << latitude_deg;
  }
}

TEST(WorldMagneticModel, HoldsAtThePolesAndAcrossTheDateLine) {
  for (const double latitude_deg : {-90.0, 90.0}) {
    const MagneticField field = field_at(latitude_deg, 12, 0, 2026);
    EXPECT_TRUE(field.north_east_down_uT.allFinite());
    EXPECT_NEAR(field.total_uT(), field_at(latitude_deg * 0.9999999, 12, 0, 2026).total_uT(), 1e-4);
    // The horizontal vector is the same seen from any meridian.
    EXPECT_NEAR(field.horizontal_uT(), field_at(latitude_deg, 100, 0, 2026).horizontal_uT(), 1e-6);
  }
  EXPECT_NEAR(
      (field_at(10, 180, 0, 2026).north_east_down_uT - field_at(10, -180, 0, 2026).north_east_down_uT).norm(), 0,
      1e-9);
}

TEST(WorldMagneticModel, KnowsItsYears) {
  EXPECT_DOUBLE_EQ(decimal_year(1735689600'000000000), 2025.0);
  EXPECT_NEAR(decimal_year(1767225600'000000000 - 1), 2026.0, 1e-9);
  EXPECT_NEAR(decimal_year(1835481600'000000000), 2028 + 60.0 / 366, 1e-9);  // 2028-03-01, a leap year
  EXPECT_TRUE(wmm_covers(2025.0));
  EXPECT_TRUE(wmm_covers(2029.99));
  EXPECT_FALSE(wmm_covers(2030.0));
  EXPECT_FALSE(wmm_covers(2024.99));
}

}  // namespace
}  // namespace navcal::base
