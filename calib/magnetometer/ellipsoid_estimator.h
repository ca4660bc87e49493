// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "base/reference_instruments.h"
#include "calib/judgement.h"
#include "calib/magnetometer/ellipsoid_fit.h"
#include "calib/magnetometer/ellipsoid_noise.h"
#include "calib/magnetometer/field_cells.h"
#include "calib/magnetometer/magnetometer_estimate.h"

namespace navcal::calib {

/// Model: |M (m - c)| = 1 and down' M (m - c) = sin(dip), m the measured field in uT, down the direction of
/// gravity, both in body axes, M symmetric in 1/uT (EllipsoidShape). The second line is what tilt tells: with it a
/// hull that rolls and pitches by a few degrees needs not be turned over.
///
/// Weighted least squares with the noise of m propagated through both lines (Gauss-Helmert), on cells of the
/// field, one iteration every so many readings. A known field is information: its dip on sin(dip), its size by
/// keeping soft iron near the unit matrix.
class EllipsoidEstimator {
 public:
  struct Parameters {
    double noise_uT = base::reference::kFieldNoise_uT;  ///< of one reading; the data correct it
    double tilt_noise_rad =
        base::reference::kReckonedTiltNoise_rad;  ///< of one reading, at least; the data correct it
    std::optional<KnownField> known;
    double soft_iron_std = 0.15;       ///< of the soft iron matrix about the unit matrix, when the field is known
    int slice_samples = 20;            ///< readings from one iteration to the next
    double model_error = 0.002;        ///< of a cell, relative to the largest field measured
    double heading_std_rad = 0.02;     ///< the worst that is accepted, within
    double expected_tilt_rad = 0.175;  ///< this roll and pitch
    /// The worst vertical offset that is accepted, or a tenth of the horizontal one where that is more.
    double offset_std_uT = 1.0;
  };

  explicit EllipsoidEstimator(const Parameters& parameters);

  /// Roll or pitch not a number: the tilt is not known, the size of the field still tells.
  void update(const Eigen::Vector3d& field_body_uT, double roll_rad, double pitch_rad);
  /// Sets the known size and dip of the field, as a prior that the data correct.
  void set_known(const std::optional<KnownField>& known) { parameters_.known = known; }
  void set_tilt_noise(double tilt_noise_rad) { parameters_.tilt_noise_rad = tilt_noise_rad; }
  void settle();
  /// Takes over the summary of readings of the same field.
  void absorb(const EllipsoidEstimator& other);

  [[nodiscard]] std::optional<MagnetometerEstimate> estimate() const;
  [[nodiscard]] const std::optional<EllipsoidFit>& fit() const { return fit_; }
  /// The summary: those with tilt, then those without.
  [[nodiscard]] EllipsoidCells cells() const;
  [[nodiscard]] const EllipsoidNoise& noise() const { return noise_; }
  /// Error of centre, matrix and dip, enlarged by the residuals that noise alone does not explain.
  [[nodiscard]] EllipsoidError error() const;
  [[nodiscard]] Judgement judgement() const;
  /// Largest angle between the hull's vertical axis and the plumb line among the cells.
  [[nodiscard]] double tilt_seen_rad() const;

  void archive(Archive& archive);

 private:
  void begin();
  void iterate();
  [[nodiscard]] EllipsoidNoise believed() const;

  Parameters parameters_;
  FieldCells<3, 6> cells_;
  FieldCells<3, 6> tiltless_;  ///< readings whose tilt is not known: down is zero
  std::optional<EllipsoidFit> fit_;
  ResidualBlocks blocks_;
  EllipsoidNoise noise_;  ///< by the scatter about the fit
  std::uint64_t samples_ = 0;
};

}  // namespace navcal::calib
