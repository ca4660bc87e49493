// SPDX-License-Identifier: Apache-2.0
#include "calib/gps/misalignment.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace navcal::calib {

Misalignment::Misalignment(const Parameters& parameters) : parameters_(parameters), run_(parameters.run) {}

void Misalignment::update_heading(double time_s, double heading_rad) {
  if (const auto line = run_.update_heading(time_s, heading_rad)) add(*line, closed_);
}

void Misalignment::update(const GroundReading& ground) {
  if (const auto line = run_.update(ground)) add(*line, closed_);
}

void Misalignment::add(const StraightRun::Line& line, Sum& sum) const {
  const double offset_rad = line.heading_rad - line.course_rad;
  if (sum.runs == 0) sum.about_rad = std::remainder(offset_rad, 2 * std::numbers::pi);
  const double sine = std::sin(line.heading_rad), cosine = std::cos(line.heading_rad);
  const Eigen::Vector3d row(1, sine / line.speed_m_s, -cosine / line.speed_m_s);
  const double weight =
      1 / (line.course_std_rad * line.course_std_rad + parameters_.run_std_rad * parameters_.run_std_rad);
  sum.information += weight * row * row.transpose();
  const double from_first_rad = std::remainder(offset_rad - sum.about_rad, 2 * std::numbers::pi);
  sum.right += weight * row * from_first_rad;
  sum.square += weight * from_first_rad * from_first_rad;
  sum.directions += weight * Eigen::Vector2d(cosine, sine);
  sum.length_m += line.length_m;
  ++sum.runs;
}

std::optional<Misalignment::Estimate> Misalignment::estimate() const {
  Sum sum = closed_;
  if (const auto line = run_.line()) add(*line, sum);
  if (sum.runs == 0) return std::nullopt;
  Eigen::Matrix3d information = sum.information;
  information.diagonal().tail<2>().array() += 1 / (parameters_.current_std_m_s * parameters_.current_std_m_s);
  const Eigen::LDLT<Eigen::Matrix3d> solver(information);
  const Eigen::Vector3d solution = solver.solve(sum.right);
  const Eigen::Matrix3d covariance = solver.solve(Eigen::Matrix3d::Identity());
  Estimate estimate;
  estimate.offset_rad = std::remainder(sum.about_rad + solution[0], 2 * std::numbers::pi);
  // Of an uncalibrated compass the offset depends on the heading, and more runs do not make it known better.
  if (sum.runs > 1)
    estimate.scatter = std::sqrt(std::max(1.0, (sum.square - sum.right.dot(solution)) / (sum.runs - 1)));
  estimate.offset_std_rad = estimate.scatter * std::sqrt(covariance(0, 0));
  estimate.offset_std_without_current_rad = estimate.scatter / std::sqrt(sum.information(0, 0));
  // Seen from headings that are all off by A, the current is turned by as much.
  estimate.current_m_s = Eigen::Rotation2Dd(-estimate.offset_rad) * solution.tail<2>();
  estimate.current_std_m_s = covariance.diagonal().tail<2>().cwiseSqrt();
  estimate.runs = sum.runs;
  estimate.length_m = sum.length_m;
  estimate.direction_balance = 1 - sum.directions.norm() / sum.information(0, 0);
  return estimate;
}

Judgement Misalignment::judgement() const {
  Judgement judgement;
  const auto found = estimate();
  if (!found) {
    return judgement.refused("no straight run at the surface yet",
                             "run straight at the surface, 100 m or more, then the same way back");
  }
  judgement.samples = found->runs;
  judgement.coverage = found->direction_balance;
  const double least = found->offset_std_without_current_rad;
  judgement.condition = found->offset_std_rad / least;
  const bool contradict = found->scatter > parameters_.most_scatter;
  judgement.accepted = found->offset_std_rad <= parameters_.accepted_std_rad && !contradict;
  if (judgement.accepted) return judgement;
  if (contradict)
    return judgement.refused("the runs contradict each other: the error of the heading depends on the heading",
                             "calibrate the compass first: turn full circles, both ways round");
  if (least <= parameters_.accepted_std_rad)
    return judgement.refused("all runs lead one way: a current could feign the misalignment",
                             "run straight the other way, as long again");
  return judgement.refused("the runs are too short for fixes of this accuracy",
                           "run straight at the surface, 100 m or more, both ways");
}

void Misalignment::archive(Archive& archive) {
  archive.tag("misalignment 2");
  archive(run_, closed_);
}

}  // namespace navcal::calib
