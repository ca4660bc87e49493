// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "calib/archive.h"
#include "calib/readings.h"

namespace navcal::calib {

/// Model: p(t) = p0 + V t for the fixes of a straight run (m; north, east), fitted by least squares in time; its
/// direction has the standard deviation sigma_p sqrt(12) / (L sqrt(N)) (THESIS 5.1, section 10). The path steered
/// by the compass, the integral of (cos psi, sin psi), is fitted at the same instants by the same line: what the
/// helmsman wanders is weighted alike in both and cancels from their difference. Finds where runs begin and end;
/// running sums only.
class StraightRun {
 public:
  struct Parameters {
    double position_std_m = 2.5;
    double least_speed_m_s = 0.4;         ///< over ground: slower, and the receiver holds its position
    double turn_rate_limit_rad_s = 0.06;  ///< averaged over a second
    double band_rad = 0.2;                ///< the run ends when the heading leaves its beginning by more
    double settle_s = 3;                  ///< straight for so long before the run begins: slip dies away
    double longest_gap_s = 5;             ///< between fixes, and between headings a tenth of it
    double jump_sigmas = 6;               ///< of a fix off the line; it is left out
    double least_length_m = 25;
    double longest_s = 300;  ///< a longer run is taken as several
    std::uint32_t least_fixes = 12;
  };
  /// Result of one run.
  struct Line {
    double course_rad = 0;      ///< of the fixes
    double heading_rad = 0;     ///< of the compass, weighted as the fixes
    double speed_m_s = 0;       ///< over ground
    double course_std_rad = 0;  ///< sigma_p sqrt(12) / (L sqrt(N)) in its exact form
    double length_m = 0;
    std::uint32_t fixes = 0;
  };
  /// Numbers of fixes and readings that were not used, by reason.
  struct LeftOut {
    std::uint64_t slow = 0, jumps = 0, turning = 0, no_heading = 0;
    void archive(Archive& archive) { archive(slow, jumps, turning, no_heading); }
  };

  StraightRun() : StraightRun(Parameters{}) {}
  explicit StraightRun(const Parameters& parameters);

  /// Each of these may end the run. It then returns the line of the run, if the run was long enough.
  std::optional<Line> update_heading(double time_s, double heading_rad);
  std::optional<Line> update(const GroundReading& ground);

  /// The run under way, if it is long enough already.
  [[nodiscard]] std::optional<Line> line() const;
  [[nodiscard]] double length_m() const;  ///< of the run under way
  [[nodiscard]] const LeftOut& left_out() const { return left_out_; }
  void archive(Archive& archive);

 private:
  /// Least-squares line through points in time: sums about the first point.
  struct Fit {
    double n = 0, t = 0, tt = 0;
    Eigen::Vector2d x = Eigen::Vector2d::Zero(), tx = Eigen::Vector2d::Zero();
    void add(double time_s, const Eigen::Vector2d& point);
    [[nodiscard]] double time_scatter_s2() const;
    [[nodiscard]] Eigen::Vector2d slope() const;
    [[nodiscard]] Eigen::Vector2d at(double time_s) const;
    void archive(Archive& archive) { archive(n, t, tt, x, tx); }
  };
  std::optional<Line> end();
  [[nodiscard]] double heading_gap_s() const;
  [[nodiscard]] bool off_the_line(const GroundReading& ground) const;

  Parameters parameters_;
  // Headings.
  bool has_heading_ = false;
  double heading_time_s_ = 0, heading_rad_ = 0, turn_rate_rad_s_ = 0;
  double straight_since_s_ = 0, first_heading_rad_ = 0;
  Eigen::Vector2d steered_ = Eigen::Vector2d::Zero();  ///< integral of (cos psi, sin psi), s
  // The run.
  double first_fix_s_ = 0, last_fix_s_ = 0;
  Eigen::Vector2d first_fix_m_ = Eigen::Vector2d::Zero(), first_steered_s_ = Eigen::Vector2d::Zero();
  Fit fixes_, compass_;
  std::uint32_t jumps_in_a_row_ = 0;
  LeftOut left_out_;
};

}  // namespace navcal::calib
