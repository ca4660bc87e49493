// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace navcal::base {

/// A point on or above the WGS 84 ellipsoid.
struct GeodeticPosition {
  double latitude_rad = 0;
  double longitude_rad = 0;
  double height_m = 0;  ///< above the ellipsoid
};

/// The Earth's main magnetic field at one place and time.
struct MagneticField {
  Eigen::Vector3d north_east_down_uT = Eigen::Vector3d::Zero();  ///< geodetic frame

  [[nodiscard]] double horizontal_uT() const;
  [[nodiscard]] double total_uT() const;
  [[nodiscard]] double declination_rad() const;  ///< magnetic north from true north, positive east
  [[nodiscard]] double dip_rad() const;          ///< positive down
};

/// Field by the World Magnetic Model 2025: spherical harmonics to degree 12 with linear secular variation (NOAA
/// NCEI and BGS, The US/UK World Magnetic Model for 2025-2030, section 1.2). Published standard errors: about 0.13
/// uT north, 0.09 east, 0.14 down; local iron and rock are not in the model. Within 0.01 m of the Earth's axis,
/// north is the direction of the meridian given. `decimal_year` may lie outside of wmm_covers(); the field is then
/// extrapolated.
[[nodiscard]] MagneticField world_magnetic_field(const GeodeticPosition& position, double decimal_year);

/// Whether the model is valid at that time.
[[nodiscard]] bool wmm_covers(double decimal_year);

/// Year with its elapsed fraction, from nanoseconds since 1970-01-01 UTC (leap seconds not counted).
[[nodiscard]] double decimal_year(std::int64_t utc_ns);

}  // namespace navcal::base
