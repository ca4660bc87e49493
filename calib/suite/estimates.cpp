// SPDX-License-Identifier: Apache-2.0
// What the estimators say, in the words of Correction and Report.
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "calib/suite/estimators.h"

namespace navcal::calib {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::infinity();
constexpr std::array<std::string_view, 5> kCoefficients{"A_rad", "B_rad", "C_rad", "D_rad", "E_rad"};
constexpr std::array<std::string_view, Swing::kHeadings> kSwingHeadings{"N_rad", "NE_rad", "E_rad", "SE_rad",
                                                                        "S_rad", "SW_rad", "W_rad", "NW_rad"};

double std_of(double variance) { return variance >= 0 ? std::sqrt(variance) : kUnknown; }

// Standard errors from which on the readings have not told more than was known before them.
constexpr double kScaleUnknown = 1;
constexpr double kRateUnknown_rad_s = 1;
constexpr double kDeviationUnknown_rad = std::numbers::pi;
constexpr double kGpsDeviationUnknown_rad = 0.09;  // of a prior of 0.1 (GpsCompass)

/// A number that the readings determine to better than `unknown`; else no number.
Quantity quantity(std::string_view name, double value, double std, double unknown) {
  if (!(std < unknown)) return {name, std::numeric_limits<double>::quiet_NaN(), kUnknown};
  return {name, value, std};
}

RateCorrection rate_of(const TurnFilterBank& filter) {
  const TurnCoefficients estimate = filter.estimate();
  return {estimate[kScale], estimate[kBias]};
}

DeviationCorrection deviation_of(const TurnFilterBank& filter) {
  const TurnCoefficients estimate = filter.estimate();
  return {{0, estimate[kB], estimate[kC], estimate[kD], estimate[kE]}};
}

DeviationCorrection deviation_of(const GpsCompass::Vector& unknowns) {
  return {{unknowns[0], unknowns[1], unknowns[2], unknowns[3], unknowns[4]}};
}

/// The gyro knows no north: what all eight have in common is A and none of its business.
std::optional<SwingCorrection> swing_of(const Swing& swing) {
  const auto table_rad = swing.table_rad();
  if (!table_rad) return std::nullopt;
  SwingCorrection correction{*table_rad};
  const double mean_rad = std::accumulate(table_rad->begin(), table_rad->end(), 0.0) / Swing::kHeadings;
  for (double& deviation_rad : correction.deviation_rad) deviation_rad -= mean_rad;
  return correction;
}

std::vector<Quantity> quantities_of_gyro(const TurnCalibrator& gyro) {
  if (!gyro.has_estimate()) return {};
  const TurnCoefficients estimate = gyro.filter().estimate();
  const TurnCovariance covariance = gyro.filter().covariance();
  return {quantity("scale", estimate[kScale], std_of(covariance(kScale, kScale)), kScaleUnknown),
          quantity("bias_rad_s", estimate[kBias], std_of(covariance(kBias, kBias)), kRateUnknown_rad_s)};
}

std::vector<Quantity> quantities_of_compass(const TurnCalibrator& compass) {
  std::vector<Quantity> quantities;
  if (!compass.has_estimate()) return quantities;
  const TurnCoefficients estimate = compass.filter().estimate();
  const TurnCovariance covariance = compass.filter().covariance();
  for (int i = kB; i <= kE; ++i) {
    const int above_A = i - kB + 1;
    quantities.push_back(quantity(kCoefficients[static_cast<std::size_t>(above_A)], estimate[i],
                                  std_of(covariance(i, i)), kDeviationUnknown_rad));
  }
  return quantities;
}

std::vector<Quantity> quantities_of(const std::optional<MagnetometerEstimate>& estimate) {
  if (!estimate) return {};
  const auto& offset = estimate->correction.offset_uT;
  const auto& std = estimate->offset_std_uT;
  const auto &matrix = estimate->correction.matrix, &matrix_std = estimate->matrix_std;
  std::vector<Quantity> quantities{{"offset_x_uT", offset.x(), std.x()},
                                   {"offset_y_uT", offset.y(), std.y()},
                                   {"offset_z_uT", offset.z(), std.z()},
                                   {"field_uT", estimate->field_uT, kUnknown},
                                   {"residual_uT", estimate->residual_uT, kUnknown},
                                   {"worst_heading_rad", 0, estimate->heading_std_rad},
                                   {"matrix_xx", matrix(0, 0), matrix_std(0, 0)},
                                   {"matrix_yy", matrix(1, 1), matrix_std(1, 1)},
                                   {"matrix_zz", matrix(2, 2), matrix_std(2, 2)},
                                   {"matrix_yz", matrix(1, 2), matrix_std(1, 2)},
                                   {"matrix_xz", matrix(0, 2), matrix_std(0, 2)},
                                   {"matrix_xy", matrix(0, 1), matrix_std(0, 1)}};
  if (estimate->field_scale > 0)
    quantities.push_back({"field_scale", estimate->field_scale, estimate->field_scale_std});
  return quantities;
}

std::vector<Quantity> quantities_of(const std::optional<GpsCompass::Estimate>& estimate) {
  std::vector<Quantity> quantities;
  if (!estimate) return quantities;
  const auto std = [&](int i) { return std_of(estimate->covariance(i, i)); };
  for (int i = 0; i < 5; ++i)
    quantities.push_back(quantity(kCoefficients[static_cast<std::size_t>(i)], estimate->unknowns[i], std(i),
                                  kGpsDeviationUnknown_rad));
  constexpr std::array<std::string_view, 4> kOthers{"speed_scale", "slip_s", "current_north_m_s",
                                                    "current_east_m_s"};
  for (int i = 0; i < 4; ++i)
    quantities.push_back({kOthers[static_cast<std::size_t>(i)], estimate->unknowns[5 + i], std(5 + i)});
  return quantities;
}

std::vector<Quantity> quantities_of(const Swing& swing) {
  std::vector<Quantity> quantities;
  const auto headings = swing.headings();
  for (std::size_t i = 0; i < headings.size(); ++i) {
    if (headings[i].rests > 0)
      quantities.push_back({kSwingHeadings[i], headings[i].deviation_rad, headings[i].std_rad});
  }
  return quantities;
}

std::vector<Quantity> quantities_of(const std::optional<MotorCurrent::Estimate>& estimate) {
  if (!estimate) return {};
  const auto& slope = estimate->slope_uT_per_A;
  const auto std = [&](Eigen::Index i) { return std_of(estimate->covariance(i, i)); };
  return {{"x_uT_per_A", slope.x(), std(0)}, {"y_uT_per_A", slope.y(), std(1)}, {"z_uT_per_A", slope.z(), std(2)}};
}

std::vector<Quantity> quantities_of(const Delay& delay) {
  if (!std::isfinite(delay.std_s)) return {};
  return {{"delay_s", delay.delay_s, delay.std_s}};
}

}  // namespace

const TurnCalibrator& Estimators::turn_calibrator(Calibrator calibrator) const {
  if (calibrator == Calibrator::gyro) return gyro_;
  return calibrator == Calibrator::gyro_b ? gyro_b_ : compass_;
}

Correction Estimators::estimates() const {
  Correction estimates;
  for (const Calibrator calibrator : kCalibrators) put_estimate(calibrator, estimates);
  return estimates;
}

void Estimators::put_estimate(Calibrator calibrator, Correction& into) const {
  const auto rate = [](const TurnCalibrator& gyro) {
    return gyro.has_estimate() ? std::optional(rate_of(gyro.filter())) : std::nullopt;
  };
  const auto delay = [](const Delay& found) {
    return std::isfinite(found.std_s) ? std::optional(found.delay_s) : std::nullopt;
  };
  switch (calibrator) {
    case Calibrator::gyro:
      into.gyro = rate(gyro_);
      break;
    case Calibrator::gyro_b:
      into.gyro_b = rate(gyro_b_);
      break;
    case Calibrator::compass:
      into.compass = compass_.has_estimate() ? std::optional(deviation_of(compass_.filter())) : std::nullopt;
      break;
    case Calibrator::magnetometer: {
      const auto magnetometer = magnetometer_.estimate();
      into.magnetometer = magnetometer ? std::optional(magnetometer->correction) : std::nullopt;
      break;
    }
    case Calibrator::gps_compass: {
      const auto& gps = surface_.gps_compass().estimate();
      into.gps_compass = gps ? std::optional(deviation_of(gps->unknowns)) : std::nullopt;
      break;
    }
    case Calibrator::swing:
      into.swing = swing_ ? swing_of(*swing_) : std::nullopt;
      break;
    case Calibrator::misalignment: {
      const auto misalignment = surface_.misalignment().estimate();
      into.misalignment_rad = misalignment ? std::optional(misalignment->offset_rad) : std::nullopt;
      break;
    }
    case Calibrator::compass_delay:
      into.compass_delay_s = delay(delays_.compass());
      break;
    case Calibrator::course_delay:
      into.course_delay_s = delay(delays_.course().estimate());
      break;
    case Calibrator::motor_current: {
      const auto motor = motor_current_.estimate();
      into.motor_current = motor ? std::optional(MotorCurrentCorrection{motor->slope_uT_per_A}) : std::nullopt;
      break;
    }
  }
}

Judgement Estimators::judgement(Calibrator calibrator) const {
  switch (calibrator) {
    case Calibrator::gyro:
    case Calibrator::gyro_b:
    case Calibrator::compass:
      return turn_calibrator(calibrator).judgement();
    case Calibrator::magnetometer:
      return magnetometer_.judgement();
    case Calibrator::gps_compass:
      return surface_.gps_compass().judgement();
    case Calibrator::misalignment:
      return surface_.misalignment().judgement();
    case Calibrator::compass_delay:
      return delays_.compass_judgement();
    case Calibrator::course_delay:
      return delays_.course_judgement();
    case Calibrator::motor_current:
      return motor_current_.judgement();
    case Calibrator::swing:
      break;
  }
  if (swing_) return swing_->judgement();
  Judgement judgement;
  judgement.reason = "not begun";
  judgement.manoeuvre = "give calibration.start for swing, then rest on each of the eight headings";
  return judgement;
}

std::vector<Quantity> Estimators::quantities(Calibrator calibrator) const {
  switch (calibrator) {
    case Calibrator::gyro:
      return quantities_of_gyro(gyro_);
    case Calibrator::gyro_b: {
      auto quantities = quantities_of_gyro(gyro_b_);
      // By what is in force of both.
      if (const auto disagreement = gyros_.disagreement_rad_s())
        quantities.push_back({"disagreement_rad_s", *disagreement, gyros_.standard_error_rad_s()});
      return quantities;
    }
    case Calibrator::compass:
      return quantities_of_compass(compass_);
    case Calibrator::magnetometer:
      return quantities_of(magnetometer_.estimate());
    case Calibrator::gps_compass:
      return quantities_of(surface_.gps_compass().estimate());
    case Calibrator::swing:
      return swing_ ? quantities_of(*swing_) : std::vector<Quantity>{};
    case Calibrator::misalignment:
      if (const auto estimate = surface_.misalignment().estimate())
        return {{"A_rad", estimate->offset_rad, estimate->offset_std_rad}};
      return {};
    case Calibrator::compass_delay:
      return quantities_of(delays_.compass());
    case Calibrator::course_delay:
      return quantities_of(delays_.course().estimate());
    case Calibrator::motor_current:
      break;
  }
  return quantities_of(motor_current_.estimate());
}

Eigen::MatrixXd Estimators::covariance(Calibrator calibrator) const {
  if (calibrator == Calibrator::compass && compass_.has_estimate())
    return compass_.filter().covariance().block<4, 4>(kB, kB);
  const auto& gps = surface_.gps_compass().estimate();
  if (calibrator == Calibrator::gps_compass && gps) return gps->covariance;
  return {};
}

}  // namespace navcal::calib
