// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <complex>
#include <cstdint>
#include <optional>

#include "base/reference_instruments.h"
#include "calib/archive.h"
#include "calib/gps/gps_track.h"
#include "calib/readings.h"

namespace navcal::calib {

/// Model: velocity = current + SUM_jm C_jm v e^{i (psi_m + k0 r)} (i r)^j e^{i m psi_m} (m/s, north + i east): the
/// motion of GpsCompass is linear in the coefficients C of the harmonics of e^{-iE} (form (ii) of THESIS section
/// 9), the slip taken as a series about k0 r. Linear, hence bounded without loss: this keeps the information
/// matrix of C and of the current from all velocities and positions, and its right-hand side. Harmonics beyond the
/// sixth are below 1e-5 rad for deviations of ten degrees.
///
/// Positions enter as the innovations of a Kalman filter (white noise of the fixes on a random walk of the model),
/// through which every regressor is passed as the positions are: generalised least squares in O(1) per reading.
class GpsSummary {
 public:
  static constexpr int kHarmonics = 6;  ///< m from -6 to 6
  static constexpr int kModes = 2 * kHarmonics + 1;
  static constexpr int kSlipTerms = 3;                    ///< j from 0 to 2
  static constexpr int kTerms = kModes * kSlipTerms + 1;  ///< the last is the current
  using Complex = std::complex<double>;
  using Terms = Eigen::Matrix<Complex, kTerms, 1>;
  using Information = Eigen::Matrix<Complex, kTerms, kTerms>;

  struct Parameters {
    double velocity_std_m_s = base::reference::kVelocityNoise_m_s;  ///< of the receiver, each axis
    double position_std_m = base::reference::kPositionNoise_m;      ///< likewise
    double model_std_m_s = 0.02;     ///< of the modelled velocity: slip and speed are not quite as assumed ...
    double model_correlation_s = 2;  ///< ... for about so long
    double slip_s = -0.15;           ///< k0
    double least_speed_m_s = 0.3;    ///< over ground and through water; below, receivers hold position and course
    double longest_gap_s = 30;       ///< between fixes: over a longer one the position is not used
    double jump_sigmas = 6;  ///< two fixes that contradict their velocities by more: the position begins anew
  };
  struct LeftOut {
    std::uint64_t slow = 0, jumps = 0, no_course = 0, not_finite = 0;
    void archive(Archive& archive) { archive(slow, jumps, no_course, not_finite); }
  };

  GpsSummary() : GpsSummary(Parameters{}) {}
  explicit GpsSummary(const Parameters& parameters) : parameters_(parameters) {}

  void advance(const WaterTrackReading& begin, const WaterTrackReading& end);
  void fix(const GroundReading& ground, const WaterTrackReading& track);
  /// The positions before have no bearing on those that come.
  void begin_anew() { position_.reset(); }

  [[nodiscard]] const Information& information() const { return information_; }  ///< lower triangle
  [[nodiscard]] const Terms& right() const { return right_; }
  [[nodiscard]] double square() const { return square_; }  ///< weighted sum of squares of what was observed
  /// Sum of the velocities seen from the headings: its angle is -A, roughly, with no other unknown known.
  [[nodiscard]] Complex velocity_from_heading() const { return velocity_from_heading_; }
  [[nodiscard]] std::uint64_t fixes() const { return fixes_; }
  [[nodiscard]] const LeftOut& left_out() const { return left_out_; }
  [[nodiscard]] static constexpr int index(int slip_power, int harmonic) {
    return slip_power * kModes + harmonic + kHarmonics;
  }
  void archive(Archive& archive);

 private:
  /// The filter of positions: its state without the model's velocity, and the response of each term.
  struct Position {
    Complex state_m;
    double variance_m2 = 0;
    Terms response = Terms::Zero();
    // The last fix, with which the next one is compared in the test for jumps.
    double time_s = 0;
    Complex fix_m, velocity_m_s;
    void archive(Archive& archive);
  };
  [[nodiscard]] Terms terms(const WaterTrackReading& track) const;
  void observe(const Terms& terms, Complex observed, double variance);
  [[nodiscard]] bool jumped(const GroundReading& ground, Complex velocity_m_s) const;

  Parameters parameters_;
  Information information_ = Information::Zero();
  Terms right_ = Terms::Zero();
  double square_ = 0;
  Complex velocity_from_heading_;
  std::uint64_t fixes_ = 0;
  LeftOut left_out_;
  std::optional<Position> position_;
};

}  // namespace navcal::calib
