// SPDX-License-Identifier: Apache-2.0
#include "calib/gps/straight_run.h"

#include <algorithm>
#include <cmath>

#include "base/angles.h"

namespace navcal::calib {
namespace {

constexpr double kRateMemory_s = 1;
constexpr double kFixesForJumps = 5;
constexpr std::uint32_t kJumpsToEnd = 3;  // it is not the fixes that are wrong

Eigen::Vector2d direction(double angle_rad) { return {std::cos(angle_rad), std::sin(angle_rad)}; }
double angle_of(const Eigen::Vector2d& vector) { return std::atan2(vector.y(), vector.x()); }

}  // namespace

StraightRun::StraightRun(const Parameters& parameters) : parameters_(parameters) {}

void StraightRun::Fit::add(double time_s, const Eigen::Vector2d& point) {
  n += 1;
  t += time_s;
  tt += time_s * time_s;
  x += point;
  tx += time_s * point;
}

double StraightRun::Fit::time_scatter_s2() const { return tt - t * t / n; }
Eigen::Vector2d StraightRun::Fit::slope() const { return (tx - x * (t / n)) / time_scatter_s2(); }
Eigen::Vector2d StraightRun::Fit::at(double time_s) const { return x / n + slope() * (time_s - t / n); }

std::optional<StraightRun::Line> StraightRun::update_heading(double time_s, double heading_rad) {
  if (!std::isfinite(time_s + heading_rad)) return std::nullopt;
  std::optional<Line> ended;
  const double duration_s = time_s - heading_time_s_;
  if (has_heading_ && duration_s <= 0) return std::nullopt;
  if (!has_heading_ || duration_s > heading_gap_s()) {
    ended = end();
    turn_rate_rad_s_ = 0;
    straight_since_s_ = time_s;
    first_heading_rad_ = heading_rad;
  } else {
    const double turn_rad = std::remainder(heading_rad - heading_rad_, base::kTurn_rad);
    steered_ += duration_s * direction(heading_rad_ + turn_rad / 2);
    turn_rate_rad_s_ -= std::expm1(-duration_s / kRateMemory_s) * (turn_rad / duration_s - turn_rate_rad_s_);
    const bool turning =
        std::abs(turn_rate_rad_s_) > parameters_.turn_rate_limit_rad_s ||
        std::abs(std::remainder(heading_rad - first_heading_rad_, base::kTurn_rad)) > parameters_.band_rad;
    if (turning) {
      ended = end();
      straight_since_s_ = time_s;
      first_heading_rad_ = heading_rad;
    }
  }
  has_heading_ = true;
  heading_time_s_ = time_s;
  heading_rad_ = heading_rad;
  return ended;
}

std::optional<StraightRun::Line> StraightRun::update(const GroundReading& ground) {
  if (!std::isfinite(ground.time_s + ground.speed_m_s) || !ground.position_m.allFinite()) return std::nullopt;
  if (ground.speed_m_s < parameters_.least_speed_m_s) {
    ++left_out_.slow;
    return end();
  }
  const double since_heading_s = ground.time_s - heading_time_s_;
  if (!has_heading_ || since_heading_s < 0 || since_heading_s > heading_gap_s()) {
    ++left_out_.no_heading;
    return end();
  }
  if (ground.time_s < straight_since_s_ + parameters_.settle_s) {
    ++left_out_.turning;
    return std::nullopt;
  }
  std::optional<Line> ended;
  if (fixes_.n > 0) {
    if (ground.time_s <= last_fix_s_) return std::nullopt;
    if (ground.time_s - last_fix_s_ > parameters_.longest_gap_s ||
        ground.time_s - first_fix_s_ > parameters_.longest_s) {
      ended = end();
    } else if (off_the_line(ground)) {
      ++left_out_.jumps;
      if (++jumps_in_a_row_ < kJumpsToEnd) return std::nullopt;
      ended = end();
    }
  }
  if (fixes_.n == 0) {
    first_fix_s_ = ground.time_s;
    first_fix_m_ = ground.position_m;
    first_steered_s_ = steered_;
  }
  jumps_in_a_row_ = 0;
  last_fix_s_ = ground.time_s;
  const double time_s = ground.time_s - first_fix_s_;
  fixes_.add(time_s, ground.position_m - first_fix_m_);
  compass_.add(time_s, steered_ + since_heading_s * direction(heading_rad_) - first_steered_s_);
  return ended;
}

double StraightRun::heading_gap_s() const { return parameters_.longest_gap_s / 10; }

bool StraightRun::off_the_line(const GroundReading& ground) const {
  if (fixes_.n < kFixesForJumps) return false;
  const double time_s = ground.time_s - first_fix_s_;
  const double from_mean_s = time_s - fixes_.t / fixes_.n;
  const double std_m = parameters_.position_std_m *
                       std::sqrt(1 + 1 / fixes_.n + from_mean_s * from_mean_s / fixes_.time_scatter_s2());
  // A course within the band may lead off the line by so much, and no jump is as small.
  const double wander_m = parameters_.band_rad * ground.speed_m_s * parameters_.settle_s;
  const Eigen::Vector2d off_m = ground.position_m - first_fix_m_ - fixes_.at(time_s);
  return off_m.norm() > parameters_.jump_sigmas * std_m + wander_m;
}

double StraightRun::length_m() const {
  return fixes_.n < 2 ? 0 : fixes_.slope().norm() * (last_fix_s_ - first_fix_s_);
}

std::optional<StraightRun::Line> StraightRun::line() const {
  if (fixes_.n < std::max(parameters_.least_fixes, 2U) || length_m() < parameters_.least_length_m)
    return std::nullopt;
  const Eigen::Vector2d velocity_m_s = fixes_.slope();
  const double speed_m_s = velocity_m_s.norm();
  return Line{.course_rad = angle_of(velocity_m_s),
              .heading_rad = angle_of(compass_.slope()),
              .speed_m_s = speed_m_s,
              .course_std_rad = parameters_.position_std_m / (speed_m_s * std::sqrt(fixes_.time_scatter_s2())),
              .length_m = length_m(),
              .fixes = static_cast<std::uint32_t>(fixes_.n)};
}

std::optional<StraightRun::Line> StraightRun::end() {
  const auto result = line();
  fixes_ = {};
  compass_ = {};
  jumps_in_a_row_ = 0;
  return result;
}

void StraightRun::archive(Archive& archive) {
  archive.tag("straight_run 1");
  archive(has_heading_, heading_time_s_, heading_rad_, turn_rate_rad_s_, straight_since_s_, first_heading_rad_);
  archive(steered_, first_fix_s_, last_fix_s_, first_fix_m_, first_steered_s_, fixes_, compass_);
  archive(jumps_in_a_row_, left_out_);
}

}  // namespace navcal::calib
