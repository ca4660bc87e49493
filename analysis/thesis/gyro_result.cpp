// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "analysis/thesis/thesis_parts.h"
#include "base/angles.h"
#include "calib/thesis/adaptive_identifier.h"
#include "calib/thesis/turn_problem.h"

namespace navcal::analysis {

namespace thesis = calib::thesis;

std::optional<double> thesis_settled_s(const std::vector<double>& time_s, const std::vector<double>& scale,
                                       const std::vector<double>& bias_rad_s) {
  std::optional<double> since;
  for (std::size_t i = 0; i < std::min(time_s.size(), scale.size()); ++i) {
    const bool close = std::abs(scale[i] / thesis::kTrueScale - 1) < kThesisSettled &&
                       std::abs(bias_rad_s[i] / thesis::kTrueBias_rad_s - 1) < kThesisSettled;
    if (!close)
      since.reset();
    else if (!since)
      since = time_s[i];
  }
  return since;
}

ThesisGyro thesis_gyro_result(const ThesisPath& path, int runs, std::uint64_t seed) {
  const Eigen::Vector2d truth(thesis::kTrueScale, thesis::kTrueBias_rad_s);
  ThesisGyro result;
  thesis::Random random(seed);
  const auto clean = thesis::measure(thesis::TurnProblem::gyro, path, thesis::kNoNoise, random);
  result.least_squares = thesis::thesis_gyro(clean);
  result.adaptive = thesis::thesis_adaptive(clean);
  result.navcal = thesis::filtered(thesis::TurnProblem::gyro, clean).estimate().head<2>();
  Eigen::Vector2d least_squares = Eigen::Vector2d::Zero(), adaptive = Eigen::Vector2d::Zero();
  for (int run = 0; run < runs; ++run) {
    const auto readings = thesis::measure(thesis::TurnProblem::gyro, path, thesis::Noise{}, random);
    least_squares += (thesis::thesis_gyro(readings) - truth).cwiseAbs2() / runs;
    adaptive += (thesis::thesis_adaptive(readings) - truth).cwiseAbs2() / runs;
  }
  result.least_squares_rms = least_squares.cwiseSqrt();
  result.adaptive_rms = adaptive.cwiseSqrt();
  const thesis::TurnStatistics ours = thesis::monte_carlo(thesis::TurnProblem::gyro, path, runs, seed);
  result.navcal_rms = ours.rms;
  result.bound = ours.bound;
  const auto settle = [&](bool noisy, std::optional<double>& adaptive_s, std::optional<double>& navcal_s) {
    const ThesisTurnTrace trace = thesis_turn_trace(path, 0, noisy, seed);
    adaptive_s = thesis_settled_s(trace.time_s, trace.adaptive_scale, trace.adaptive_bias_rad_s);
    navcal_s = thesis_settled_s(trace.time_s, trace.navcal_scale, trace.navcal_bias_rad_s);
  };
  settle(false, result.adaptive_settled_s, result.navcal_settled_s);
  settle(true, result.adaptive_noisy_settled_s, result.navcal_noisy_settled_s);
  return result;
}

namespace {

/// Heading rate of the exact kinematics (2.9).
double heading_rate(const thesis::TruePoint& p) {
  return (std::sin(p.roll_rad) * p.rate_rad_s.y() + std::cos(p.roll_rad) * p.rate_rad_s.z()) /
         std::cos(p.pitch_rad);
}

void add_motion(ThesisTurnTrace& trace, const ThesisPath& path, const std::vector<thesis::Measured>& readings) {
  for (std::size_t k = 0; k < path.size(); ++k) {
    trace.time_s.push_back(path[k].time_s);
    trace.north_m.push_back(path[k].position_m.x());
    trace.east_m.push_back(path[k].position_m.y());
    trace.heading_rad.push_back(path[k].heading_rad);
    trace.roll_deg.push_back(path[k].roll_rad * base::kDegreesPerRadian);
    trace.rate_rad_s.push_back(heading_rate(path[k]));
    trace.measured_rate_rad_s.push_back(readings[k].rate_rad_s.z());
  }
}

/// (3.1) with an estimate, integrated by forward Euler (3.2).
ThesisRateErrors errors_of(const Eigen::Vector2d& estimate, const ThesisTurnTrace& trace,
                           const std::vector<thesis::Measured>& readings) {
  ThesisRateErrors errors;
  double heading_rad = trace.heading_rad.front();
  for (std::size_t k = 0; k < readings.size(); ++k) {
    const thesis::Measured& m = readings[k];
    const double rate =
        std::cos(m.roll_rad) / std::cos(m.pitch_rad) * (estimate[0] * m.rate_rad_s.z() + estimate[1]);
    errors.rate_rad_s.push_back(trace.rate_rad_s[k] - rate);
    errors.heading_rad.push_back(trace.heading_rad[k] - heading_rad);
    heading_rad += thesis::kPeriod_s * rate;
  }
  return errors;
}

void add_adaptive(ThesisTurnTrace& trace, const std::vector<thesis::Measured>& readings) {
  thesis::AdaptiveIdentifier identifier(thesis::kPeriod_s);
  double unwrapped = trace.heading_rad.front();
  for (std::size_t k = 0; k < readings.size(); ++k) {
    const thesis::Measured& m = readings[k];
    unwrapped += base::wrapped(m.heading_rad - unwrapped);
    trace.adaptive_state_error_rad.push_back(trace.heading_rad[k] - identifier.heading_rad().value_or(unwrapped));
    identifier.update(unwrapped, m.roll_rad, m.pitch_rad, m.rate_rad_s.z());
    trace.adaptive_scale.push_back(identifier.estimate()[0]);
    trace.adaptive_bias_rad_s.push_back(identifier.estimate()[1]);
  }
}

/// Our filter, as it learns and with its last estimate; a step's rate is the mean over the step.
void add_navcal(ThesisTurnTrace& trace, const std::vector<thesis::Measured>& readings) {
  calib::TurnFilter filter = thesis::turn_filter(calib::TurnPrior::unknown_gyro());
  const std::vector<calib::TurnStep> steps = thesis::turn_steps(readings);
  for (const calib::TurnStep& step : steps) {
    filter.update(step);
    trace.navcal_scale.push_back(filter.estimate()[calib::kScale]);
    trace.navcal_bias_rad_s.push_back(filter.estimate()[calib::kBias]);
  }
  const calib::TurnCoefficients last = filter.estimate();
  double heading_rad = trace.heading_rad.front(), before_rad = heading_rad;
  for (std::size_t k = 0; k < steps.size(); ++k) {
    const calib::TurnStep& step = steps[k];
    const double turned = last[calib::kScale] * step.measured_angle_rad + last[calib::kBias] * step.bias_time_s +
                          step.tilt_angle_rad;
    heading_rad += turned;
    const double error = trace.heading_rad[k] - before_rad - turned;
    trace.navcal.rate_rad_s.push_back(k > 0 ? error / step.duration_s : std::nan(""));
    trace.navcal.heading_rad.push_back(trace.heading_rad[k] - heading_rad);
    before_rad = trace.heading_rad[k];
  }
}

}  // namespace

ThesisTurnTrace thesis_turn_trace(const ThesisPath& path, int number, bool noisy, std::uint64_t seed) {
  thesis::Random random(seed);
  const auto readings =
      thesis::measure(thesis::TurnProblem::gyro, path, noisy ? thesis::Noise{} : thesis::kNoNoise, random);
  ThesisTurnTrace trace;
  trace.path = number;
  trace.noisy = noisy;
  add_motion(trace, path, readings);
  trace.least_squares = errors_of(thesis::thesis_gyro(readings), trace, readings);
  trace.adaptive = errors_of(thesis::thesis_adaptive(readings), trace, readings);
  add_adaptive(trace, readings);
  add_navcal(trace, readings);
  return trace;
}

}  // namespace navcal::analysis
