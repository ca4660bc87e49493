// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "base/reference_instruments.h"
#include "calib/judgement.h"
#include "calib/magnetometer/ellipse_fit.h"
#include "calib/magnetometer/field_cells.h"
#include "calib/magnetometer/magnetometer_estimate.h"

namespace navcal::calib {

/// Model: levelled field = centre + S u(psi) + noise, every psi free (EllipseShape); uT, forward and starboard.
///
/// Maximum likelihood, that is least orthogonal distance, by Gauss-Newton from Taubin's fit (Taubin, IEEE Trans.
/// PAMI 13, 1991; Ahn, Rauh and Warnecke, Pattern Recognition 34, 2001), on the cells of the field: one iteration
/// every so many readings, and to the end with settle().
class EllipseEstimator {
 public:
  struct Parameters {
    double noise_uT = base::reference::kFieldNoise_uT;  ///< of one reading; the data correct it
    int slice_samples = 10;                             ///< readings from one iteration to the next
    double model_error_uT = 0.05;   ///< of a cell however many readings: what is not an ellipse about the field
    double heading_std_rad = 0.02;  ///< the worst that is accepted
    double least_arc_rad = 2.6;     ///< without a gyro; THESIS 11.6
  };

  explicit EllipseEstimator(const Parameters& parameters);

  void update(const Eigen::Vector3d& field_body_uT, double roll_rad, double pitch_rad);
  void settle();
  /// Takes over the summary of readings of the same field.
  void absorb(const EllipseEstimator& other);

  [[nodiscard]] std::optional<MagnetometerEstimate> estimate() const;
  [[nodiscard]] const std::optional<EllipseFit>& fit() const { return fit_; }
  [[nodiscard]] const FieldCells<2, 4>& cells() const { return cells_; }
  [[nodiscard]] Judgement judgement() const;

  void archive(Archive& archive);

 private:
  Parameters parameters_;
  FieldCells<2, 4> cells_;
  std::optional<EllipseFit> fit_;
  std::uint64_t samples_ = 0;
};

}  // namespace navcal::calib
