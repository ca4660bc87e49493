// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "calib/archive.h"
#include "calib/gps/gps_coefficients.h"
#include "calib/gps/gps_summary.h"
#include "calib/gps/gps_track.h"
#include "calib/judgement.h"
#include "calib/readings.h"

namespace navcal::calib {

/// Model: velocity over ground = c + s v e^{i (psi_m + d - E(psi_m) + k r)} (m/s, north + i east), observed as GPS
/// velocity and, integrated, as position; E of (2.7) with A..E, d the known declination (rad), v the speed through
/// water as the caller knows it (m/s), s its scale, k r the slip (r turn rate, rad/s; k in s), c the current.
/// Form (iv) of THESIS section 9, which closes the problem its Appendix A left open: maximum a posteriori by
/// Gauss-Newton in nine unknowns. Its data are kept as GpsSummary, bounded however long the mission, in which the
/// harmonics of e^{-iE} are linear: it can be solved anew at any estimate, nothing stays linearised at an old one.
/// Refitted every so many fixes.
class GpsCompass {
 public:
  static constexpr int kUnknowns =
      GpsCoefficients::kUnknowns;  ///< A B C D E (rad), speed scale, slip (s), current north, east (m/s)
  using Vector = GpsCoefficients::Unknowns;
  using Matrix = Eigen::Matrix<double, kUnknowns, kUnknowns>;
  struct Parameters {
    GpsSummary::Parameters summary;
    double declination_rad = 0;
    double offset_std_rad = 10;       ///< prior of A: none
    double deviation_std_rad = 0.35;  ///< prior of each of B..E
    double speed_scale_std = 0.2;     ///< prior about 1
    double slip_s = -0.15, slip_std_s = 0.1;
    double current_std_m_s = 0.3;       ///< prior, each axis
    std::uint32_t slice_fixes = 10;     ///< a refit each so many fixes
    double accepted_std_rad = 0.01745;  ///< of the corrected heading, worst over the circle
  };
  struct Estimate {
    Vector unknowns = Vector::Zero();
    Matrix covariance = Matrix::Zero();
    std::uint64_t fixes = 0;         ///< used
    double worst_std_rad = 0;        ///< of the corrected heading, worst over the circle
    double worst_heading_rad = 0;    ///< and where
    double reduced_chi_squared = 0;  ///< of what was observed; above 1 it has widened the covariance
    bool converged = false;
    void archive(Archive& archive) {
      archive(unknowns, covariance, fixes, worst_std_rad, worst_heading_rad, reduced_chi_squared, converged);
    }
  };

  GpsCompass() : GpsCompass(Parameters{}) {}
  explicit GpsCompass(const Parameters& parameters);

  void update(const WaterTrackReading& track);
  /// Takes a fix, in order of time with the track.
  void update(const GroundReading& ground);

  /// Takes effect at the next refit.
  void set_declination(double declination_rad) { parameters_.declination_rad = declination_rad; }

  /// Estimate after the newest slice of fixes; nullopt before the first slice.
  [[nodiscard]] const std::optional<Estimate>& estimate() const { return estimate_; }
  /// Estimate from the sums of all fixes, iterated from the initial guess. The estimate by slices must agree
  /// with it.
  [[nodiscard]] std::optional<Estimate> solve() const;
  [[nodiscard]] Judgement judgement() const;
  [[nodiscard]] const HeadingHistogram& rose() const { return rose_; }
  [[nodiscard]] const GpsSummary& summary() const { return summary_; }
  void archive(Archive& archive);

 private:
  [[nodiscard]] Estimate iterate(Vector x, int steps) const;

  Parameters parameters_;
  GpsTrack track_;
  GpsSummary summary_;
  std::uint64_t fitted_fixes_ = 0;
  HeadingHistogram rose_{};
  std::optional<Estimate> estimate_;
};

}  // namespace navcal::calib
