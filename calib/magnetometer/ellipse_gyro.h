// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/reference_instruments.h"
#include "calib/judgement.h"
#include "calib/magnetometer/ellipse_chain.h"
#include "calib/magnetometer/ellipse_shape.h"
#include "calib/magnetometer/magnetometer_estimate.h"
#include "calib/turn/turn_step.h"

namespace navcal::calib {

/// Model: levelled field = centre + S u(psi_k) + noise, and psi_k+1 - psi_k = scale S1 + bias S2 + T (TurnStep)
/// + the integral of the gyro's noise; uT, radians, rad/s. The gyro says where on the ellipse one is, so that
/// arcs too short to be told from a circle suffice (THESIS 11.4, 11.6). Scale and bias are unknowns with the
/// covariance of their calibration; a wide one makes it the joint fit.
///
/// Maximum likelihood over shape, gyro and all psi by Gauss-Newton, the headings being a chain and so eliminated
/// one after the other (Golub and Van Loan, Matrix Computations, 4.3). Of groups of readings; the newest
/// kCapacity.
class EllipseGyro {
 public:
  static constexpr std::size_t kCapacity = 512;
  using Matrix = EllipseChain::Matrix;

  struct Parameters {
    double noise_uT = base::reference::kFieldNoise_uT;
    double rate_noise_rad_sqrt_s = 0.0016;  ///< density: standard deviation of a rate times sqrt(its period)
    GyroBelief gyro;
    int slice_samples = 20;         ///< readings from one iteration to the next
    double model_error_uT = 0.05;   ///< as for the ellipse
    double heading_std_rad = 0.02;  ///< the worst that is accepted
  };

  explicit EllipseGyro(const Parameters& parameters);

  void update(const Eigen::Vector3d& field_body_uT, double roll_rad, double pitch_rad, const TurnStep& turn);
  /// A gyro calibrated meanwhile.
  void set_gyro(const GyroBelief& gyro);
  void settle();

  [[nodiscard]] std::optional<MagnetometerEstimate> estimate() const;
  [[nodiscard]] std::optional<EllipseShape> shape() const;
  [[nodiscard]] Eigen::Vector2d gyro() const { return chain_.gyro; }  ///< scale, bias, with what this fit adds
  [[nodiscard]] Matrix covariance() const;
  [[nodiscard]] Judgement judgement() const;
  /// Covariance of the shape. It includes the misfit, a vertical offset of kVerticalOffset_uT, and an error of
  /// `model_error_uT` common to each ten degrees of heading.
  [[nodiscard]] EllipseShape::Matrix stated_covariance(double model_error_uT) const;
  [[nodiscard]] const std::vector<TurnGroup>& groups() const { return groups_; }

  void archive(Archive& archive);

 private:
  void add(const Eigen::Vector2d& field_uT, const Eigen::Vector2d& vertical, const Eigen::Vector4d& way,
           bool begins_segment);
  void iterate();

  Parameters parameters_;
  std::vector<TurnGroup> groups_;
  EllipseChain chain_;
  bool shape_found_ = false;
  bool broken_ = false;                                    ///< the way from the last reading is not known
  Eigen::Vector4d way_ = Eigen::Vector4d::Zero();          ///< time, S1, S2, T since the segment began
  Eigen::Vector4d group_begin_ = Eigen::Vector4d::Zero();  ///< the same at the newest group's first reading
  std::uint64_t samples_ = 0;
};

}  // namespace navcal::calib
