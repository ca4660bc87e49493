// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "calib/archive.h"
#include "calib/turn/turn_step.h"

namespace navcal::calib {

/// Scale and bias of a yaw gyro, true rate = scale * measured + bias (2.12), and the deviation B, C, D, E of a
/// compass, psi = psi_m - A - f4(psi_m)'q (2.7, 2.8); rad/s and radians. A is in no turn: it stays in the heading.
using TurnCoefficients = Eigen::Matrix<double, 6, 1>;
using TurnCovariance = Eigen::Matrix<double, 6, 6>;
enum TurnCoefficient : int { kScale, kBias, kB, kC, kD, kE };

/// Prior of the coefficients. A variance of zero fixes a coefficient: a compass without error, or a gyro that
/// is known exactly. The covariance of an earlier gyro calibration serves as prior of the gyro.
struct TurnPrior {
  TurnCoefficients mean = TurnCoefficients::Unit(kScale);
  TurnCovariance covariance = TurnCovariance::Zero();
  std::array<bool, 6> sought{};  ///< those that are to be found: loose, and not correlated with any other

  /// The compass has no error, the gyro is unknown (THESIS chapter 3).
  [[nodiscard]] static TurnPrior unknown_gyro();
  /// The gyro is known, the compass is not (section 4.2); the covariance that of (scale, bias).
  [[nodiscard]] static TurnPrior unknown_compass(double scale, double bias_rad_s,
                                                 const Eigen::Matrix2d& gyro_covariance);
  /// Neither is known (the thesis's major problem, THESIS 11.3).
  [[nodiscard]] static TurnPrior unknown_both();
};

/// Model: the row of an innovation, (innovation at the prior's constants; its gradient in scale, B, C, D, E),
/// bears the noise of gyro and compass in its gradient, too, since measured rate and measured heading are
/// regressors. This carries the second moments of that noise through TurnFilter's first stage and sums what noise
/// alone puts into the products of rows. Rows are linear in the noise; of the harmonics that is to first order.
/// Radians.
class TurnNoise {
 public:
  using Row = Eigen::Matrix<double, 6, 1>;
  using Products = Eigen::Matrix<double, 6, 6>;

  /// Restarts the heading with one reading, whose noise enters a row along `direction`.
  void start(const Row& direction, double variance);
  /// The turn by gyro adds noise along `direction`.
  void predict(double bias_time_s, const Row& direction, double variance);
  /// A reading is weighed with 1/innovation_variance and moves heading and bias by `gain`.
  void correct(const Row& direction, double variance, double innovation_variance, const Eigen::Vector2d& gain);

  /// Expectation of the sum of row * row' / innovation_variance, as far as it is noise.
  [[nodiscard]] const Products& expected() const { return expected_; }

  void archive(Archive& archive) { archive(heading_, heading_bias_, bias_, expected_); }

 private:
  // Moments of the noise in the rows of heading and bias: heading with heading, with bias, bias with bias.
  Products heading_ = Products::Zero(), heading_bias_ = Products::Zero(), bias_ = Products::Zero();
  Products expected_ = Products::Zero();
};

/// Model: psi_m(n) - T(n) = psi0 + scale S1(n) + bias S2(n) + f4(psi_m(n))'q + heading noise (white) + scale times
/// the integral of the gyro's rate noise (a random walk), S1, S2, T the sums of TurnStep (THESIS 11.7), psi0 one
/// for each segment; the bias may itself walk. Radians, rad/s, heading clockwise from magnetic north less A.
///
/// One filter for three calibrations, told apart by the prior: gyro (errorless compass), compass (known gyro),
/// both together. Friedland's two stages (IEEE Trans. Automatic Control 14, 1969): a Kalman filter for heading and
/// bias, the constants entering through their sensitivities, on whose innovations they are found by weighted least
/// squares. That equals generalised least squares over all readings.
///
/// Measured rate and measured heading are regressors with noise: it pulls the scale towards zero where the rate
/// hardly changes, and bends scale and deviation together where only part of the circle is seen. The expectation
/// of that pull is subtracted (corrected score; Nakamura, Biometrika 77, 1990), as much of it as the residuals
/// bear out. Where what is left is no more than the noise, all constants stay as believed before.
class TurnFilter {
 public:
  struct Parameters {
    double heading_noise_rad = 0.004;       ///< standard deviation of one compass reading
    double rate_noise_rad_sqrt_s = 0.0016;  ///< density: standard deviation of a reading times sqrt(its period)
    double bias_walk_rad_s_sqrt_s = 0;      ///< density of the random walk of the bias; 0: it is constant
  };

  explicit TurnFilter(const Parameters& parameters, const TurnPrior& prior = TurnPrior::unknown_both());

  void update(const TurnStep& step);
  /// The turn up to the next reading is unknown; what was learnt is kept.
  void begin_segment() { in_segment_ = false; }

  [[nodiscard]] TurnCoefficients estimate() const;
  /// Covariance of the estimate, multiplied by reduced_chi_squared() when that exceeds 1.
  [[nodiscard]] TurnCovariance covariance() const;
  /// Condition number of the data's information on the coefficients sought, scaled to unit diagonal. Large:
  /// they are hardly separable. Infinite: the data do not determine one of them.
  [[nodiscard]] double condition() const;
  /// Mean square of the normalised innovations at the estimate: 1 when the noise is as stated, with standard
  /// deviation sqrt(2/readings()).
  [[nodiscard]] double reduced_chi_squared() const;
  /// Log-likelihood of all readings, up to a constant that depends on neither walk nor noise. The constants
  /// sought are left open.
  [[nodiscard]] double log_likelihood() const { return log_likelihood_; }
  /// Heading at the last reading, less A.
  [[nodiscard]] double heading_rad() const;
  [[nodiscard]] std::uint64_t readings() const { return readings_; }  ///< that told something
  [[nodiscard]] std::uint64_t left_out() const { return left_out_; }  ///< not finite, or no time between them

  /// The prior is part of the state, the parameters are not.
  void archive(Archive& archive);

 private:
  /// The constant parameters: scale, B, C, D, E.
  using Constants = Eigen::Matrix<double, 5, 1>;
  using ConstantsMatrix = Eigen::Matrix<double, 5, 5>;
  using Row = TurnNoise::Row;
  /// Solution of the sums so far, with the constants as departures from the prior.
  struct Solution {
    Constants departure = Constants::Zero();
    ConstantsMatrix covariance = ConstantsMatrix::Zero();
    double square = 0;           ///< sum of the squares of normalised innovations
    double expected_square = 1;  ///< its expectation by the stated noise
    void archive(Archive& archive) { archive(departure, covariance, square, expected_square); }
  };
  /// A compass reading: unwrapped and less the prior's deviation; 0; harmonics of the constants not held.
  struct Reading {
    Row row = Row::Zero();
    Row slope = Row::Zero();  ///< of the row, by the measured heading
  };

  [[nodiscard]] bool held(int coefficient) const;
  [[nodiscard]] Reading reading(double measured_rad) const;
  [[nodiscard]] double scale_as_known() const;
  void unwrap(const TurnStep& step);
  void start(const TurnStep& step);
  void predict(const TurnStep& step);
  void correct(double measured_rad);
  void solve();
  [[nodiscard]] TurnCovariance unscaled_covariance() const;

  Parameters parameters_;
  TurnPrior prior_;
  ConstantsMatrix prior_information_;

  // First stage: heading and bias, negative, at the prior's constants (first column), and how they depend on the
  // constants (the others).
  Eigen::Matrix<double, 2, 6> track_ = Eigen::Matrix<double, 2, 6>::Zero();
  Eigen::Matrix2d covariance_ = Eigen::Matrix2d::Zero();
  TurnNoise noise_;

  // Second stage: sums over the rows of the innovations.
  TurnNoise::Products products_ = TurnNoise::Products::Zero();
  double log_variances_ = 0;  ///< sum of the logarithms of the innovations' variances
  Solution solution_;
  double log_likelihood_ = 0;

  double measured_rad_ = 0;   ///< newest reading
  double unwrapped_rad_ = 0;  ///< the same, continuous
  double time_s_ = 0;         ///< of the newest reading
  bool in_segment_ = false;
  std::uint64_t readings_ = 0;
  std::uint64_t innovations_ = 0;
  std::uint64_t left_out_ = 0;
};

}  // namespace navcal::calib
