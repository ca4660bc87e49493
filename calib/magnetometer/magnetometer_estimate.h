// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "calib/correction.h"

namespace navcal::calib {

/// Hard and soft iron, with what is known of their errors.
struct MagnetometerEstimate {
  FieldCorrection correction;  ///< calibrated = matrix * (measured - offset), body axes
  Eigen::Vector3d offset_std_uT = Eigen::Vector3d::Zero();  ///< infinite: not determined (vertical, of an ellipse)
  Eigen::Matrix3d matrix_std = Eigen::Matrix3d::Zero();     ///< infinite: not determined
  double residual_uT = 0;  ///< root-mean-square distance of the readings from the fitted curve or surface
  double field_uT = 0;     ///< fitted size of the horizontal field (2-D) or of the field (3-D)
  /// Size of the field as measured, once its shape is round, over the size that was given beforehand; 0 where none
  /// was. Away from 1 the magnetometer's scale is off, or what is known of the field.
  double field_scale = 0, field_scale_std = 0;
  double heading_std_rad = 0;  ///< of the calibrated heading, at the worst heading of the circle
  std::uint64_t samples = 0;
};

/// The Earth's field where the vehicle is, by a model or a map.
struct KnownField {
  double magnitude_uT = 48;
  double dip_rad = 1.1;           ///< positive downwards
  double magnitude_std_uT = 0.5;  ///< of the map, with what the place adds to it
  double dip_std_rad = 0.01;
  void archive(Archive& archive) { archive(magnitude_uT, dip_rad, magnitude_std_uT, dip_std_rad); }
};

/// Difference of the readings right after a step and right before it, for a hull that hardly turned meanwhile.
struct FieldContrast {
  Eigen::Vector3d size_uT = Eigen::Vector3d::Zero();
  Eigen::Vector3d std_uT = Eigen::Vector3d::Zero();
  void archive(Archive& archive) { archive(size_uT, std_uT); }
};

/// A field that stepped in mid-mission: a motor switched on, a magnet near.
struct FieldStep {
  std::uint64_t onset_sample = 0;  ///< the first reading of the new field, counted from 1
  std::uint64_t found_sample = 0;
  bool returned = false;                              ///< to the field before the last step, whose summary goes on
  double time_s = 0;                                  ///< of the first reading of the new field
  std::int64_t utc_ns = 0;                            ///< the same; 0: not known
  Eigen::Vector3d size_uT = Eigen::Vector3d::Zero();  ///< hard iron after less hard iron before, body axes
  Eigen::Vector3d std_uT = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  std::optional<FieldContrast> contrast;
  bool is_place = false;  ///< no step of the vehicle's field: it is at another place, or back at the one before
  void archive(Archive& archive) {
    archive(onset_sample, found_sample, returned, time_s, utc_ns, size_uT, std_uT, contrast);
  }
};

/// Change of the hard iron over steps of the field.
struct IronShift {
  Eigen::Vector3d by_uT = Eigen::Vector3d::Zero(), variance_uT2 = Eigen::Vector3d::Zero();
  void archive(Archive& archive) { archive(by_uT, variance_uT2); }
};

/// The time between two steps of the field.
struct FieldSegment {
  double begin_s = 0, end_s = 0;  ///< first and last reading
  std::int64_t begin_utc_ns = 0, end_utc_ns = 0;
  std::uint64_t readings = 0;
  double raw_mean_uT = 0, raw_squares_uT2 = 0;  ///< of the size of the field: mean, squares about it
  /// Standard deviation over mean of the size calibrated for this segment; nullopt: not fitted yet.
  std::optional<double> spread_calibrated;

  /// Standard deviation over mean of the size as measured.
  [[nodiscard]] std::optional<double> spread_raw() const {
    if (readings < 2 || !(raw_mean_uT > 0)) return std::nullopt;
    return std::sqrt(raw_squares_uT2 / static_cast<double>(readings - 1)) / raw_mean_uT;
  }
  void archive(Archive& archive) {
    archive(begin_s, end_s, begin_utc_ns, end_utc_ns, readings, raw_mean_uT, raw_squares_uT2, spread_calibrated);
  }
};

}  // namespace navcal::calib
