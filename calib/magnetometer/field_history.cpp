// SPDX-License-Identifier: Apache-2.0
#include "calib/magnetometer/field_history.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "calib/magnetometer/field_cells.h"

namespace navcal::calib {
namespace {

/// Fewer readings give no shape of their own.
constexpr std::uint64_t kLeastReadings = 20;

/// A step that is smaller in all axes is none, in standard errors.
constexpr double kLeastErrors = 3;

/// Variance of the size over its mean squared.
double square(const SizeSpread& spread) {
  return spread.mean > 0 ? spread.std * spread.std / (spread.mean * spread.mean) : 0;
}

/// The size of the field alone: tilt that accelerations falsify has no part in it.
EllipsoidCells without_tilt(EllipsoidCells cells) {
  for (auto& cell : cells) cell.mean.tail<3>().setZero();
  return cells;
}

void archive_all(Archive& archive, auto& list) {
  std::uint64_t count = list.size();
  archive(count);
  if (!archive.saving()) list.assign(archive.ok() && count <= FieldHistory::kMost + 1 ? count : 0, {});
  for (auto& one : list) archive(one);
}

/// True when the field was seen from about one side only. Then any heading explains it, and the fit does not
/// determine its hard iron.
bool rested(const EllipsoidCells& cells, const EllipsoidShape& shape, const Eigen::Vector3d& centre_uT) {
  constexpr double kLeastScatter = 0.05;  // of the unit vectors, of 1
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  double count = 0;
  for (const auto& cell : cells) {
    mean += cell.count * (shape.matrix_per_uT * (cell.mean.head<3>() - centre_uT)).normalized();
    count += cell.count;
  }
  return count > 0 && 1 - (mean / count).squaredNorm() < kLeastScatter;
}

}  // namespace

FieldHistory::FieldHistory() : before_(kCellSize_uT), now_(kCellSize_uT) {}

void FieldHistory::add(const FieldCells<3, 6>::Cell& reading, double time_s, std::int64_t utc_ns) {
  if (segments_.empty()) segments_.emplace_back();
  FieldSegment& segment = segments_.back();
  if (segment.readings == 0) {
    segment.begin_s = time_s;
    segment.begin_utc_ns = utc_ns;
  }
  segment.end_s = time_s;
  segment.end_utc_ns = utc_ns;
  ++segment.readings;
  const double size_uT = reading.mean.head<3>().norm();
  const double apart_uT = size_uT - segment.raw_mean_uT;
  segment.raw_mean_uT += apart_uT / static_cast<double>(segment.readings);
  segment.raw_squares_uT2 += apart_uT * (size_uT - segment.raw_mean_uT);
  now_.add(reading.mean);
}

void FieldHistory::begin_segment(const FieldStep& step) {
  if (steps_.size() == kMost) {
    steps_.erase(steps_.begin());
    segments_.erase(segments_.begin());
  }
  steps_.push_back(step);
  segments_.emplace_back();
  before_ = now_;
  now_ = FieldCells<3, 6>(kCellSize_uT);
  next_refinement_ = kFirstRefinement;
}

bool FieldHistory::refine(const SegmentNoise& of_readings, const SegmentBelief& belief, bool is_sure) {
  // Lag, accelerations and whatever else no model describes are alike in neighbouring cells.
  constexpr double kAlike = 2.2;
  SegmentNoise noise = of_readings;
  noise.model_uT *= kAlike;
  noise.tilt_error_rad *= kAlike;
  next_refinement_ = 2 * std::max(readings(), kFirstRefinement);
  if (readings() < kLeastReadings && steps_.empty()) return false;
  const std::array both{&before_.cells(), &now_.cells()};
  const bool alone = steps_.empty() || before_.cells().empty();  // after one that was withdrawn
  const auto fit = fit_segments(alone ? Segments(both).last(1) : Segments(both), noise, belief);
  if (!fit) return false;
  tell_spreads(noise, belief);
  if (alone) return false;
  FieldStep& step = steps_.back();
  if (step.contrast && (rested(before_.cells(), fit->shape, fit->centres_uT.front()) ||
                        rested(now_.cells(), fit->shape, fit->centres_uT.back()))) {
    step.size_uT = step.contrast->size_uT;
    step.std_uT = step.contrast->std_uT;
    return false;
  }
  step.size_uT = fit->centres_uT[1] - fit->centres_uT[0];
  const double values = 2 * static_cast<double>(before_.cells().size() + now_.cells().size());
  const double freedom = std::max(1., values - EllipsoidShape::kParameters - 3);
  // Residuals that are larger than the noise says: everything is less certain.
  const double larger = std::max(1., fit->cost / freedom);
  step.std_uT = (larger * fit->covariance.diagonal().segment<3>(EllipsoidShape::kParameters)).cwiseSqrt();
  const bool is_nothing = (step.size_uT.array().abs() < kLeastErrors * step.std_uT.array()).all();
  // A field that returned has its summary of before: nothing is made one there.
  if (is_sure || step.returned || !(is_nothing || one_field_explains(*fit, noise, belief))) return false;
  withdraw();
  refine(of_readings, belief);
  return true;
}

IronShift FieldHistory::shift_over(std::size_t count) const {
  std::array<double, kMost> times{};  // that a step is in the sum; one back takes the step before away
  double sign = 1;
  for (std::size_t i = 0, step = 0; i < steps_.size(); ++i) {
    const bool back = i > 0 && steps_[i].returned;
    sign = back ? -sign : 1;
    if (!back) step = i;
    if (i + count >= steps_.size()) times[step] += sign;
  }
  IronShift shift;
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    if (times[i] == 0) continue;
    shift.by_uT += times[i] * steps_[i].size_uT;
    shift.variance_uT2 += times[i] * times[i] * steps_[i].std_uT.cwiseAbs2();
  }
  return shift;
}

void FieldHistory::tell_spreads(const SegmentNoise& noise, const SegmentBelief& belief) {
  const bool alone = before_.cells().empty();
  const EllipsoidCells before = without_tilt(before_.cells()), now = without_tilt(now_.cells());
  const std::array both{&before, &now};
  const auto fit = fit_segments(alone ? Segments(both).last(1) : Segments(both), noise, belief);
  if (!fit) return;
  const auto spread = [&](const EllipsoidCells& cells, const Eigen::Vector3d& centre_uT) {
    const SizeSpread size = spread_of(cells, fit->shape.matrix_per_uT, centre_uT);
    return size.mean > 0 ? std::optional(size.std / size.mean) : std::nullopt;
  };
  segments_.back().spread_calibrated = spread(now, fit->centres_uT.back());
  if (!alone) segments_[segments_.size() - 2].spread_calibrated = spread(before, fit->centres_uT.front());
}

bool FieldHistory::one_field_explains(const SegmentsFit& two, const SegmentNoise& noise,
                                      const SegmentBelief& belief) const {
  EllipsoidCells all = without_tilt(before_.cells());
  const EllipsoidCells now = without_tilt(now_.cells());
  all.insert(all.end(), now.begin(), now.end());
  const EllipsoidCells* const together[] = {&all};
  const auto one = fit_segments(together, noise, belief, &two.shape);
  if (!one) return false;
  const SizeSpread of_one = spread_of(all, one->shape.matrix_per_uT, one->centres_uT.front());
  const EllipsoidCells before_alone = without_tilt(before_.cells());
  const std::array apart{&before_alone, &now};
  const auto each = fit_segments(apart, noise, belief, &two.shape);
  if (!each) return false;
  const SizeSpread of_before = spread_of(before_alone, each->shape.matrix_per_uT, each->centres_uT[0]);
  const SizeSpread of_now = spread_of(now, each->shape.matrix_per_uT, each->centres_uT[1]);
  const auto& last = segments_.back();
  const auto& before = segments_[segments_.size() - 2];
  const double total = static_cast<double>(before.readings + last.readings);
  const double of_two2 = (static_cast<double>(before.readings) * square(of_before) +
                          static_cast<double>(last.readings) * square(of_now)) /
                         total;
  constexpr double kTolerance = 1.1;  // two fields have three unknowns more
  return square(of_one) <= kTolerance * of_two2;
}

void FieldHistory::withdraw() {
  steps_.pop_back();
  const FieldSegment last = segments_.back();
  segments_.pop_back();
  FieldSegment& whole = segments_.back();
  const double count = static_cast<double>(whole.readings), more = static_cast<double>(last.readings);
  const double apart_uT = last.raw_mean_uT - whole.raw_mean_uT;
  whole.raw_squares_uT2 += last.raw_squares_uT2 + apart_uT * apart_uT * count * more / (count + more);
  whole.raw_mean_uT += apart_uT * more / (count + more);
  whole.readings += last.readings;
  whole.end_s = last.end_s;
  whole.end_utc_ns = last.end_utc_ns;
  for (const auto& cell : now_.cells()) before_.add(cell);
  now_ = before_;
  before_ = FieldCells<3, 6>(kCellSize_uT);
}

void FieldHistory::archive(Archive& archive) {
  archive.tag("field_history 1");
  archive_all(archive, steps_);
  archive_all(archive, segments_);
  archive(before_, now_, next_refinement_);
}

}  // namespace navcal::calib
