// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>

#include "calib/archive.h"
#include "calib/judgement.h"

namespace navcal::calib {

/// Model: deviation(psi_m) = psi_m - psi_ref (rad), averaged while the vehicle rests on each of the eight headings
/// 0, 45 .. 315 degrees by its own compass; psi_ref from whatever is trusted: a calibrated gyro, the GPS course of
/// a straight run, or the heading the operator gives. The practice of the REMUS work (THESIS 4.1, Stokey): the
/// deviations become a correction table, interpolated between headings; A..E of (2.7) are fitted to it beside.
class Swing {
 public:
  static constexpr std::size_t kHeadings = 8;
  struct Parameters {
    double dwell_s = 10;              ///< least rest on a heading
    double settle_s = 2;              ///< the beginning of a rest is not averaged
    double band_rad = 0.06;           ///< a rest: the compass stays within so much of its mean
    double sector_rad = 0.2;          ///< how far from the nominal heading a rest may be
    double longest_gap_s = 2;         ///< between readings of one rest
    double reference_std_rad = 0.01;  ///< of the reference on one rest, the same for all its readings
    double reading_std_rad = 0.004;   ///< of a single reading
  };
  /// One of the eight.
  struct Heading {
    double heading_rad = 0;    ///< mean of the compass there, 0..2 pi
    double deviation_rad = 0;  ///< mean
    double std_rad = 0;
    std::uint32_t rests = 0;
    std::uint64_t readings = 0;
  };
  using Coefficients = Eigen::Matrix<double, 5, 1>;
  struct Estimate {
    Coefficients deviation = Coefficients::Zero();  ///< A..E, rad
    Eigen::Matrix<double, 5, 5> covariance = Eigen::Matrix<double, 5, 5>::Zero();
    double residual_rad = 0;  ///< root-mean-square of the eight about A..E
  };

  Swing() : Swing(Parameters{}) {}
  explicit Swing(const Parameters& parameters);

  /// Heading as the compass says it and the reference at the same time.
  void update(double time_s, double measured_heading_rad, double reference_heading_rad);

  [[nodiscard]] std::array<Heading, kHeadings> headings() const;
  [[nodiscard]] std::size_t missing() const;  ///< how many of the eight
  /// The correction table: deviation at the measured headings 0, 45 .. 315 degrees; nullopt until all are there.
  /// From where the vehicle rested to the nominal heading it goes along the fitted curve.
  [[nodiscard]] std::optional<std::array<double, kHeadings>> table_rad() const;
  /// A..E; nullopt with fewer than five headings.
  [[nodiscard]] std::optional<Estimate> estimate() const;
  [[nodiscard]] Judgement judgement() const;
  void archive(Archive& archive);

 private:
  /// Weighted sums over all rests on a heading: of the means, of the headings relative to the nominal one, and
  /// of the deviations from the first rest there.
  struct Sums {
    double weight = 0, heading = 0, deviation = 0, about_rad = 0;
    std::uint32_t rests = 0;
    std::uint64_t readings = 0;
    void archive(Archive& archive) { archive(weight, heading, deviation, about_rad, rests, readings); }
  };
  /// The rest under way; sums as above.
  struct Rest {
    std::size_t sector = 0;
    double begin_s = 0, last_s = 0;
    double mean_rad = 0;  ///< of all its headings, from the nominal one
    std::uint64_t of_mean = 0;
    double heading = 0, deviation = 0, about_rad = 0;
    std::uint64_t readings = 0;  ///< after it had settled
    void archive(Archive& archive) {
      archive(sector, begin_s, last_s, mean_rad, of_mean, heading, deviation, about_rad, readings);
    }
  };
  void add(const Rest& rest, std::array<Sums, kHeadings>& sums) const;
  /// Sums for each heading, including the present rest when it is long enough.
  [[nodiscard]] std::array<Sums, kHeadings> sums() const;

  Parameters parameters_;
  std::array<Sums, kHeadings> sums_{};
  std::optional<Rest> rest_;
};

}  // namespace navcal::calib
