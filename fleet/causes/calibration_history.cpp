// SPDX-License-Identifier: Apache-2.0
#include "fleet/causes/calibration_history.h"

#include <algorithm>
#include <cmath>

#include "base/enum_name.h"

// Each course is a linear model of the values with their stated errors: a constant; a constant and a slope; two
// constants. They are compared by the Bayesian information criterion (Schwarz 1978), which for a step counts
// the place as a parameter, too. Errors that are too small for even the best course grow by one scatter
// (Mandel and Paule 1970), and the comparison is made with those.
namespace navcal::fleet {
namespace {

constexpr std::size_t kLeastPoints = 3;
/// Difference of the criterion, nats, from which a course that is no constant is stated.
constexpr double kDecides_nats = 5;

/// Weighted least squares on a constant and at most one regressor.
struct CourseFit {
  double misfit = 0;  ///< chi-square
  double constant = 0, constant_std = 0, slope = 0, slope_std = 0;
};

CourseFit fit(const std::vector<CalibrationPoint>& points, double excess, const std::vector<double>* regressor) {
  double w = 0, wx = 0, wy = 0, wxx = 0, wxy = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double weight = 1 / (points[i].std * points[i].std + excess * excess);
    const double x = regressor != nullptr ? (*regressor)[i] : 0;
    w += weight;
    wx += weight * x;
    wy += weight * points[i].value;
    wxx += weight * x * x;
    wxy += weight * x * points[i].value;
  }
  CourseFit result;
  const double spread = wxx - wx * wx / w;
  if (regressor != nullptr && spread > 0) {
    result.slope = (wxy - wx * wy / w) / spread;
    result.slope_std = std::sqrt(1 / spread);
  }
  result.constant = (wy - result.slope * wx) / w;
  result.constant_std = std::sqrt(1 / w);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double variance = points[i].std * points[i].std + excess * excess;
    const double x = regressor != nullptr ? (*regressor)[i] : 0;
    const double left = points[i].value - result.constant - result.slope * x;
    result.misfit += left * left / variance;
  }
  return result;
}

/// A course with its fit and its criterion.
struct Course {
  CalibrationCourse course = CalibrationCourse::constant;
  std::size_t step_at = 0;
  CourseFit fit;
  double cost_nats = 0;
  int unknowns = 1;
};

std::vector<double> days_of(const std::vector<CalibrationPoint>& points) {
  std::vector<double> days;
  for (const CalibrationPoint& point : points) {
    days.push_back(static_cast<double>(point.utc_ns - points.front().utc_ns) / kNanosecondsPerDay);
  }
  return days;
}

std::vector<double> step_of(std::size_t count, std::size_t at) {
  std::vector<double> step(count, 0.0);
  std::fill(step.begin() + static_cast<std::ptrdiff_t>(at), step.end(), 1.0);
  return step;
}

/// The course with the least cost.
Course best_course(const std::vector<CalibrationPoint>& points, double excess) {
  const auto n = static_cast<double>(points.size());
  const auto cost = [&](const CourseFit& of, int unknowns) {
    return 0.5 * of.misfit + 0.5 * unknowns * std::log(n);
  };
  Course best{CalibrationCourse::constant, 0, fit(points, excess, nullptr), 0, 1};
  best.cost_nats = cost(best.fit, 1);
  const double constant_nats = best.cost_nats;
  const auto consider = [&](CalibrationCourse course, std::size_t at, const std::vector<double>& regressor,
                            int unknowns) {
    Course other{course, at, fit(points, excess, &regressor), 0, unknowns};
    other.cost_nats = cost(other.fit, unknowns);
    if (other.cost_nats + kDecides_nats < constant_nats && other.cost_nats < best.cost_nats) best = other;
  };
  consider(CalibrationCourse::drift, 0, days_of(points), 2);
  for (std::size_t at = 1; at < points.size(); ++at) {
    consider(CalibrationCourse::step, at, step_of(points.size(), at), 3);
  }
  return best;
}

/// Scatter beyond the stated errors with which a course leaves as much as it should: the root of
/// chi-square(scatter) = degrees of freedom, by bisection.
double excess_of(const std::vector<CalibrationPoint>& points, const Course& course) {
  const double freedom = static_cast<double>(points.size()) - course.unknowns;
  if (freedom <= 0 || course.fit.misfit <= freedom) return 0;
  const std::vector<double> days = days_of(points), step = step_of(points.size(), course.step_at);
  const std::vector<double>* const regressor = course.course == CalibrationCourse::drift  ? &days
                                               : course.course == CalibrationCourse::step ? &step
                                                                                          : nullptr;
  double low = 0, high = 0;
  for (const CalibrationPoint& point : points) high = std::max(high, std::abs(point.value - course.fit.constant));
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (fit(points, middle, regressor).misfit > freedom ? low : high) = middle;
  }
  return high;
}

}  // namespace

std::string_view name_of(CalibrationCourse course) {
  return base::enum_name<CalibrationCourse::too_few>(course, {"constant", "drift", "step", "scatter", "too few"});
}

void judge_course(CalibrationHistory& history) {
  std::ranges::stable_sort(history.points, {}, &CalibrationPoint::utc_ns);
  history.course = CalibrationCourse::too_few;
  if (history.points.size() < kLeastPoints) return;
  Course course = best_course(history.points, 0);
  // Errors that are stated too small make a course of everything, so the comparison is made once more.
  history.excess_std = excess_of(history.points, course);
  if (history.excess_std > 0) course = best_course(history.points, history.excess_std);
  history.course = course.course;
  history.mean = course.fit.constant;
  history.mean_std = course.fit.constant_std;
  if (course.course == CalibrationCourse::drift) {
    history.drift_per_day = course.fit.slope;
    history.drift_std = course.fit.slope_std;
  } else if (course.course == CalibrationCourse::step) {
    history.step_at = course.step_at;
    history.step = course.fit.slope;
    history.step_std = course.fit.slope_std;
  } else {
    double largest = 0;
    for (const CalibrationPoint& point : history.points) largest = std::max(largest, point.std);
    if (history.excess_std > largest) history.course = CalibrationCourse::scatter;
  }
}

}  // namespace navcal::fleet
