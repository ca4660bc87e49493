#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "calib/correction.h"

namespace navcal::calib {

/// Hard and soft iron, with what is known of their errors.
struct MagnetometerEstimate {
  FieldCorrection correction;  ///< calibrated = matrix * (measured - offset), body axes
  Eigen::Vector3d offset_std_uT = Eigen::Vector3d::Zero();  ///< infinite: not determined (vertical, of an ellipse)
  double residual_uT = 0;      ///< root-mean-square distance of the readings from the fitted curve or surface
  double field_uT = 0;         ///< what was fitted: size of the horizontal field (2-D), of the field (3-D)
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

/// A field that stepped in mid-mission: a motor switched on, a magnet near.
struct FieldStep {
  std::uint64_t onset_sample = 0;  ///< the first reading of the new field, counted from 1
  std::uint64_t found_sample = 0;
  bool returned = false;  ///< to the field before the last step, whose summary goes on
  void archive(Archive& archive) { archive(onset_sample, found_sample, returned); }
};

}  // namespace navcal::calib
