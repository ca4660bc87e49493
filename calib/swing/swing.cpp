// SPDX-License-Identifier: Apache-2.0
#include "calib/swing/swing.h"

#include <cmath>
#include <string>

#include "base/angles.h"
#include "base/symmetric_solve.h"
#include "calib/gps/gps_coefficients.h"

namespace navcal::calib {
namespace {

constexpr double kSector_rad = base::kTurn_rad / Swing::kHeadings;
constexpr std::size_t kLeastForFit = 5;

double nominal_rad(std::size_t sector) { return kSector_rad * static_cast<double>(sector); }

std::size_t swing_sector(double heading_rad) {
  const double turns = heading_rad / base::kTurn_rad;
  return static_cast<std::size_t>(std::lround((turns - std::floor(turns)) * Swing::kHeadings)) % Swing::kHeadings;
}

}  // namespace

Swing::Swing(const Parameters& parameters) : parameters_(parameters) {}

void Swing::update(double time_s, double measured_heading_rad, double reference_heading_rad) {
  if (!std::isfinite(time_s + measured_heading_rad + reference_heading_rad)) return;
  if (rest_ && time_s <= rest_->last_s) return;
  const std::size_t sector = swing_sector(measured_heading_rad);
  const double heading_rad = base::wrapped(measured_heading_rad - nominal_rad(sector));
  const bool goes_on = rest_ && sector == rest_->sector && time_s - rest_->last_s <= parameters_.longest_gap_s &&
                       std::abs(heading_rad - rest_->mean_rad) <= parameters_.band_rad;
  if (rest_ && !goes_on) {
    add(*rest_, sums_);
    rest_.reset();
  }
  if (std::abs(heading_rad) > parameters_.sector_rad) return;
  const double deviation_rad = base::wrapped(measured_heading_rad - reference_heading_rad);
  if (!rest_) rest_ = Rest{.sector = sector, .begin_s = time_s, .about_rad = deviation_rad};
  rest_->last_s = time_s;
  rest_->mean_rad += (heading_rad - rest_->mean_rad) / static_cast<double>(++rest_->of_mean);
  if (time_s - rest_->begin_s < parameters_.settle_s) return;
  rest_->heading += heading_rad;
  rest_->deviation += base::wrapped(deviation_rad - rest_->about_rad);
  ++rest_->readings;
}

void Swing::add(const Rest& rest, std::array<Sums, kHeadings>& sums) const {
  if (rest.last_s - rest.begin_s < parameters_.dwell_s || rest.readings == 0) return;
  const auto readings = static_cast<double>(rest.readings);
  const double weight = 1 / (parameters_.reference_std_rad * parameters_.reference_std_rad +
                             parameters_.reading_std_rad * parameters_.reading_std_rad / readings);
  Sums& sum = sums[rest.sector];
  if (sum.rests == 0) sum.about_rad = rest.about_rad;
  sum.weight += weight;
  sum.heading += weight * rest.heading / readings;
  sum.deviation += weight * base::wrapped(rest.about_rad + rest.deviation / readings - sum.about_rad);
  ++sum.rests;
  sum.readings += rest.readings;
}

std::array<Swing::Sums, Swing::kHeadings> Swing::sums() const {
  auto sums = sums_;
  if (rest_) add(*rest_, sums);
  return sums;
}

std::array<Swing::Heading, Swing::kHeadings> Swing::headings() const {
  std::array<Heading, kHeadings> headings{};
  const auto all = sums();
  for (std::size_t i = 0; i < kHeadings; ++i) {
    const Sums& sum = all[i];
    if (sum.rests == 0) continue;
    const double heading_rad = base::wrapped(nominal_rad(i) + sum.heading / sum.weight);
    headings[i] = {.heading_rad = heading_rad < 0 ? heading_rad + base::kTurn_rad : heading_rad,
                   .deviation_rad = base::wrapped(sum.about_rad + sum.deviation / sum.weight),
                   .std_rad = 1 / std::sqrt(sum.weight),
                   .rests = sum.rests,
                   .readings = sum.readings};
  }
  return headings;
}

std::size_t Swing::missing() const {
  std::size_t count = 0;
  for (const Sums& sum : sums()) count += sum.rests == 0 ? 1 : 0;
  return count;
}

std::optional<Swing::Estimate> Swing::estimate() const {
  if (kHeadings - missing() < kLeastForFit) return std::nullopt;
  using Matrix = Eigen::Matrix<double, 5, 5>;
  const auto seen = headings();
  Matrix information = Matrix::Zero();
  Coefficients right = Coefficients::Zero();
  double about_rad = 0;  // A near half a turn must not be torn by the seam
  std::size_t count = 0;
  for (const Heading& heading : seen) {
    if (heading.rests == 0) continue;
    if (count++ == 0) about_rad = heading.deviation_rad;
    const Coefficients f = deviation_harmonics(heading.heading_rad);
    const double weight = 1 / (heading.std_rad * heading.std_rad);
    information += weight * f * f.transpose();
    right += weight * f * base::wrapped(heading.deviation_rad - about_rad);
  }
  Estimate estimate;
  estimate.deviation = base::solve_symmetric(information, right);
  estimate.deviation[0] = base::wrapped(estimate.deviation[0] + about_rad);
  estimate.covariance = base::inverse_symmetric(information);
  double square = 0;
  for (const Heading& heading : seen) {
    if (heading.rests == 0) continue;
    const double off_rad =
        base::wrapped(heading.deviation_rad - deviation_harmonics(heading.heading_rad).dot(estimate.deviation));
    square += off_rad * off_rad;
  }
  estimate.residual_rad = std::sqrt(square / static_cast<double>(count));
  return estimate;
}

std::optional<std::array<double, Swing::kHeadings>> Swing::table_rad() const {
  if (missing() > 0) return std::nullopt;
  const auto seen = headings();
  const Coefficients fitted = estimate()->deviation;
  std::array<double, kHeadings> table{};
  for (std::size_t i = 0; i < kHeadings; ++i) {
    const Coefficients way = deviation_harmonics(nominal_rad(i)) - deviation_harmonics(seen[i].heading_rad);
    table[i] = base::wrapped(seen[i].deviation_rad + way.dot(fitted));
  }
  return table;
}

Judgement Swing::judgement() const {
  Judgement judgement;
  const auto seen = headings();
  std::string wanted;
  for (std::size_t i = 0; i < kHeadings; ++i) {
    judgement.samples += seen[i].readings;
    if (seen[i].rests > 0) continue;
    wanted += (wanted.empty() ? "" : ", ") + std::to_string(45 * i);
  }
  const std::size_t still_missing = missing();
  judgement.coverage = 1 - static_cast<double>(still_missing) / kHeadings;
  judgement.accepted = still_missing == 0;
  if (judgement.accepted) return judgement;
  judgement.reason = std::to_string(still_missing) + " of the eight headings are missing";
  judgement.manoeuvre =
      "rest " + std::to_string(std::lround(parameters_.dwell_s)) + " s on each of the headings " + wanted;
  return judgement;
}

void Swing::archive(Archive& archive) {
  archive.tag("swing 1");
  archive(sums_, rest_);
}

}  // namespace navcal::calib
