// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "calib/archive.h"
#include "calib/gps/straight_run.h"
#include "calib/judgement.h"
#include "calib/readings.h"

namespace navcal::calib {

/// Model: psi_h - chi = A + (c_n sin psi - c_e cos psi) / V + slip, for each straight run at the surface; psi_h
/// the heading (rad, true) by everything known but A, chi and V the direction (rad) and speed (m/s) of the line
/// through the run's fixes, c the current (m/s, north, east) to first order. A is what is left of (2.7) when B..E
/// and declination are known: true heading = psi_h - A. THESIS 5.1 takes the mean of one run; here every run is
/// one observation of (A, c_n, c_e) with a prior on the current, so that runs in several directions tell the
/// current from A, and one direction alone says in its standard error that a current could feign it. O(1) per
/// reading.
class Misalignment {
 public:
  struct Parameters {
    StraightRun::Parameters run;
    double run_std_rad = 0.2 * 0.017453292519943295;  ///< of a run's mean heading and slip, beside its fixes
    double current_std_m_s = 0.15;                    ///< prior, each axis
    double accepted_std_rad = 0.01745;                ///< an A with a larger standard deviation is not accepted
    double most_scatter = 2;                          ///< of the runs, in their standard deviations
  };
  struct Estimate {
    double offset_rad = 0;      ///< A
    double offset_std_rad = 0;  ///< with what a current of the prior could feign, and with the scatter of the runs
    double offset_std_without_current_rad = 0;              ///< standard deviation of A in still water
    Eigen::Vector2d current_m_s = Eigen::Vector2d::Zero();  ///< north, east
    Eigen::Vector2d current_std_m_s = Eigen::Vector2d::Zero();
    std::uint32_t runs = 0;
    double length_m = 0;           ///< of all runs together
    double scatter = 1;            ///< of the runs about the estimate, in their standard deviations; at least 1
    double direction_balance = 0;  ///< 0 all runs one way .. 1 as much each way, weighted as they count
  };

  Misalignment() : Misalignment(Parameters{}) {}
  explicit Misalignment(const Parameters& parameters);

  /// Heading (true, clockwise from north) by the calibration in force without A.
  void update_heading(double time_s, double heading_rad);
  void update(const GroundReading& ground);

  /// Estimate from all runs so far; the run under way is included once it is long enough. Nullopt before any
  /// run.
  [[nodiscard]] std::optional<Estimate> estimate() const;
  [[nodiscard]] Judgement judgement() const;
  [[nodiscard]] const StraightRun& run() const { return run_; }
  void archive(Archive& archive);

 private:
  /// Information on (A, c_n, c_e), prior apart, with its right-hand side, and what the runs were.
  struct Sum {
    Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    Eigen::Vector2d directions = Eigen::Vector2d::Zero();  ///< weighted sum of unit vectors
    double about_rad = 0;  ///< the first run's A, from which the others are counted, so that no seam matters
    double length_m = 0;
    double square = 0;  ///< weighted, of the offsets from about_rad
    std::uint32_t runs = 0;
    void archive(Archive& archive) { archive(information, right, directions, about_rad, length_m, square, runs); }
  };
  void add(const StraightRun::Line& line, Sum& sum) const;

  Parameters parameters_;
  StraightRun run_;
  Sum closed_;
};

}  // namespace navcal::calib
