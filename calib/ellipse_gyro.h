#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "calib/ellipse_shape.h"
#include "calib/judgement.h"
#include "calib/magnetometer_estimate.h"
#include "calib/turn_step.h"

namespace navcal::calib {

/// Mean of neighbouring readings, less than two degrees apart, and what the gyro says of the way from the group
/// before: the regressors of TurnStep, from mean to mean.
struct TurnGroup {
  double count = 0;
  Eigen::Vector2d field_uT = Eigen::Vector2d::Zero();
  bool begins_segment = true;
  // Sums of TurnStep since the segment began, at the group's mean.
  double time_s = 0, measured_angle_rad = 0, bias_time_s = 0, tilt_angle_rad = 0;
  void archive(Archive& archive);
};

/// Scale and bias of the gyro, true rate = scale * measured + bias, as believed beforehand.
struct GyroBelief {
  Eigen::Vector2d mean{1, 0};  ///< scale; bias in rad/s
  Eigen::Matrix2d covariance = Eigen::Vector2d(0.04, 0.04).asDiagonal();
  void archive(Archive& archive) { archive(mean, covariance); }
};

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
  static constexpr int kUnknowns = EllipseShape::kParameters + 2;  ///< shape, scale, bias
  using Matrix = Eigen::Matrix<double, kUnknowns, kUnknowns>;

  struct Parameters {
    double noise_uT = 0.15;
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
  [[nodiscard]] const std::optional<EllipseShape>& shape() const { return shape_; }
  [[nodiscard]] Eigen::Vector2d gyro() const { return gyro_; }  ///< scale, bias, with what this fit adds
  [[nodiscard]] Matrix covariance() const;
  [[nodiscard]] Judgement judgement() const;
  [[nodiscard]] const std::vector<TurnGroup>& groups() const { return groups_; }

  void archive(Archive& archive);

 private:
  struct Progress;
  void add(const Eigen::Vector2d& field_uT, const TurnStep& turn);
  bool start();
  void iterate();

  Parameters parameters_;
  std::vector<TurnGroup> groups_;
  std::vector<double> headings_rad_;  ///< one for each group, when there is a shape
  std::optional<EllipseShape> shape_;
  Eigen::Vector2d gyro_;
  Matrix information_ = Matrix::Zero();
  double chi_squared_ = 0;
  bool settled_ = false;
  std::uint64_t samples_ = 0;
};

}  // namespace navcal::calib
