// SPDX-License-Identifier: Apache-2.0
// Whether the field has stepped, and what follows.
#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>

#include "calib/magnetometer/field_cells.h"
#include "calib/magnetometer/magnetometer.h"

namespace navcal::calib {
namespace {

using Cell = FieldCells<3, 6>::Cell;

/// A smaller change of hard iron is none that anybody has to know of, and none that a fit notices.
constexpr double kLeastStep_uT = 0.5;
/// Twice the logarithm of the likelihood ratio at which three more parameters are believed; 30 has a chance of
/// 1e-6 where there is no step, and errors that are alike in neighbouring readings are worth several times that.
constexpr double kLeastGain = 60;
/// Below it one field explains all; between the two more readings will tell.
constexpr double kUndecided = 8;
/// A magnet takes a second to be put on: so many readings let the new field settle.
constexpr std::uint64_t kLeastWaiting = 20;
/// Upper limit of the squared departure that a single reading contributes.
constexpr double kMostSquare = 36;
/// The step must explain this share of what the readings are off.
constexpr double kLeastShare = 0.5;
/// Readings of which a mean is taken on each side of a step, for a hull that rests.
constexpr std::size_t kContrasted = 5;
/// Standard errors of a difference that no turn of a resting hull explains.
constexpr double kCertainErrors = 6;
/// Two steps that leave a smaller share are one there and one back.
constexpr double kCancelled = 0.15;
/// Readings of a resting hull while a magnet is put on.
constexpr std::ptrdiff_t kMostBetween = 10;

double squares_of(const EllipsoidCells& cells, EllipsoidShape shape, const Eigen::Vector3d& centre_uT,
                  const SegmentNoise& noise) {
  shape.centre_uT = centre_uT;
  double sum = 0;
  for (const Cell& cell : cells) sum += std::min(segment_residual(shape, cell, noise).square(), kMostSquare);
  return sum;
}

double freedom_of(const EllipsoidCells& cells) { return static_cast<double>(2 * cells.size()); }

}  // namespace

/// One field or two, on the readings before and those that wait.
struct Magnetometer::Comparison {
  SegmentNoise noise;
  std::optional<SegmentsFit> one, two;
  EllipsoidCells waiting;
  double gain = 0;      ///< of the likelihood, twice its logarithm, in units of the scatter that remains
  bool sudden = false;  ///< the readings just before the onset are of the field before

  [[nodiscard]] Eigen::Vector3d size_uT() const { return two->centres_uT[1] - two->centres_uT[0]; }
};

Magnetometer::Comparison Magnetometer::compare() const {
  Comparison found;
  found.noise = now_.predictor.noise();
  const SegmentNoise& noise = found.noise;
  const SegmentBelief& belief = now_.predictor.belief();
  const EllipsoidCells before = now_.ellipsoid.cells();
  // While the hull rolls, the tilt lags and accelerations disturb it. Then only the size of the field is
  // compared.
  constexpr double kAgitated_rad = 0.03;
  double lag2 = 0;
  for (const Waiting& waiting : waiting_)
    lag2 += waiting.predicted.tilt_error_rad * waiting.predicted.tilt_error_rad;
  const bool agitated = lag2 > kAgitated_rad * kAgitated_rad * static_cast<double>(waiting_.size());
  // Readings at one attitude share their errors, so a cell of them counts as little more than one reading.
  FieldCells<3, 6> cells(kCellSize_uT);
  for (const Waiting& waiting : waiting_) {
    auto reading = waiting.predicted.cell.mean;
    if (agitated) reading.tail<3>().setZero();
    cells.add(reading);
  }
  found.waiting = cells.cells();
  EllipsoidCells all = before;
  all.insert(all.end(), found.waiting.begin(), found.waiting.end());
  const std::array<const EllipsoidCells*, 1> together{&all};
  const std::array<const EllipsoidCells*, 2> apart{&before, &found.waiting};
  found.one = fit_segments(together, noise, belief, &now_.predictor.shape());
  if (const auto anew = fit_segments(together, noise, belief); anew && found.one && anew->cost < found.one->cost)
    found.one = anew;
  found.two = fit_segments(apart, noise, belief, &now_.predictor.shape());
  if (!found.one || !found.two) return found;
  // The second contains the first: it may begin from there.
  if (const auto other = fit_segments(apart, noise, belief, &found.one->shape); other->cost < found.two->cost)
    found.two = other;
  const double left = squares_of(found.waiting, found.two->shape, found.two->centres_uT[1], noise);
  const double scatter = std::max(1.0, left / freedom_of(found.waiting));
  found.gain = (found.one->cost - found.two->cost) / scatter;

  // A drift has gone part of its way before the onset; a step has not begun.
  const EllipsoidCells past(past_.begin(), past_.end());
  const auto& centres = found.two->centres_uT;
  const Eigen::Vector3d half_way = (centres[0] + centres[1]) / 2;
  found.sudden =
      squares_of(past, found.two->shape, centres[0], noise) <= squares_of(past, found.two->shape, half_way, noise);
  return found;
}

void Magnetometer::decide() {
  if (waiting_.size() < kLeastWaiting) {
    next_decision_ = kLeastWaiting;
    return;
  }
  if (tell_at_rest()) return;
  const Comparison found = compare();
  if (!found.one || !found.two) {
    watch_.reset();
    release();
    return;
  }
  const SegmentNoise& noise = found.noise;
  const double unexplained = squares_of(found.waiting, found.two->shape, found.two->centres_uT[1], noise);
  const double surprising =
      squares_of(found.waiting, now_.predictor.shape(), now_.predictor.shape().centre_uT, noise);
  const bool explained = surprising - unexplained > kLeastShare * surprising;
  if (found.gain > kLeastGain && found.size_uT().norm() > kLeastStep_uT && explained && found.sudden) {
    use_those_before(onset_of(found));
    FieldStep step =
        step_at_first_waiting(found.size_uT(), found.two->covariance.diagonal().tail<3>().cwiseSqrt());
    leave_out_those_between(found);
    step.contrast = contrast(step.onset_sample, 0);
    change_field(step);
    return;
  }
  // The readings so far may fit both; more of them will tell.
  if (found.gain > kUndecided && waiting_.size() < FieldStepWatch::kLongest) {
    next_decision_ = waiting_.size() + std::max<std::size_t>(4, waiting_.size() / 2);
    return;
  }
  // A single field that explains all readings has the better fit: it replaces that of the predictor.
  const double by_one = squares_of(found.waiting, found.one->shape, found.one->shape.centre_uT, noise);
  if (by_one - unexplained <= kLeastShare * surprising) now_.predictor.set_fit(*found.one);
  watch_.reset();
  release();
}

FieldStep Magnetometer::step_at_first_waiting(const Eigen::Vector3d& size_uT,
                                              const Eigen::Vector3d& std_uT) const {
  FieldStep step;
  step.onset_sample = waiting_.front().number;
  step.found_sample = readings_;
  step.time_s = waiting_.front().reading.time_s;
  step.utc_ns = waiting_.front().reading.utc_ns;
  step.size_uT = size_uT;
  step.std_uT = std_uT;
  return step;
}

template <class Condition>
void Magnetometer::leave_out_waiting(const Condition& is_left_out) {
  const auto kept = std::remove_if(waiting_.begin(), waiting_.end(), is_left_out);
  left_out_ += static_cast<std::uint64_t>(waiting_.end() - kept);
  waiting_.erase(kept, waiting_.end());
}

bool Magnetometer::tell_at_rest() {
  const auto found = contrast(waiting_.front().number, waiting_.size() - 2 * kContrasted);
  if (!found || found->size_uT.norm() < kLeastStep_uT) return false;
  if ((found->size_uT.array().abs() < kCertainErrors * found->std_uT.array()).all()) return false;
  const Eigen::Vector3d newest_uT = waiting_.back().predicted.cell.mean.head<3>();
  const Eigen::Vector3d before_uT = newest_uT - found->size_uT;
  const auto is_of = [&](const Eigen::Vector3d& field_uT, const Waiting& waiting) {
    return (waiting.predicted.cell.mean.head<3>() - field_uT).norm() < found->size_uT.norm() / 4;
  };
  const auto is_new = [&](const Waiting& waiting) { return is_of(newest_uT, waiting); };
  const auto is_between = [&](const Waiting& waiting) { return !is_new(waiting) && !is_of(before_uT, waiting); };
  // Iron that is passed comes slowly.
  if (std::count_if(waiting_.begin(), waiting_.end(), is_between) > kMostBetween) return false;
  leave_out_waiting(std::not_fn(is_new));
  FieldStep step = step_at_first_waiting(found->size_uT, found->std_uT);
  step.contrast = found;
  change_field(step);
  return true;
}

std::size_t Magnetometer::onset_of(const Comparison& found) const {
  const SegmentNoise& noise = found.noise;
  EllipsoidShape before = found.two->shape, after = before;
  after.centre_uT = found.two->centres_uT[1];
  double sum = 0, least = 0;
  std::size_t onset = 0;
  for (std::size_t i = 0; i < waiting_.size(); ++i) {
    const auto& cell = waiting_[i].predicted.cell;
    sum += std::min(segment_residual(before, cell, noise).square(), kMostSquare) -
           std::min(segment_residual(after, cell, noise).square(), kMostSquare);
    if (sum >= least) continue;
    least = sum;
    onset = i + 1;
  }
  // The last of them belong to the new field, or there would be no step.
  return std::min(onset, waiting_.size() - 1);
}

void Magnetometer::use_those_before(std::size_t onset) {
  for (std::size_t i = 0; i < onset; ++i) use(waiting_[i]);
  waiting_.erase(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(onset));
}

void Magnetometer::leave_out_those_between(const Comparison& found) {
  const SegmentsFit& two = *found.two;
  EllipsoidShape after = two.shape;
  after.centre_uT = two.centres_uT[1];
  leave_out_waiting([&](const Waiting& waiting) {
    return segment_residual(after, waiting.predicted.cell, found.noise).square() > kMostSquare;
  });
}

std::optional<FieldContrast> Magnetometer::contrast(std::uint64_t onset, std::size_t first_waiting) const {
  constexpr double kGyroBias_rad_s = 0.1, kTilt_rad = 0.02, kUsualInterval_s = 0.1, kUnknownTurn_rad = 0.5;
  if (past_.size() < kContrasted || waiting_.size() < first_waiting + 2 * kContrasted) return std::nullopt;
  using Mean = FieldCells<3, 6>::Vector;
  // A magnet that is still on its way shows as a difference between the first readings and those that follow.
  Mean before = Mean::Zero(), first = Mean::Zero(), after = Mean::Zero();
  double turned_rad = 0;
  bool turn_known = true;
  for (std::size_t i = 0; i < kContrasted; ++i) {
    before += past_[past_.size() - 1 - i].mean / kContrasted;
    first += waiting_[first_waiting + i].predicted.cell.mean / kContrasted;
    after += waiting_[first_waiting + kContrasted + i].predicted.cell.mean / kContrasted;
  }
  for (std::size_t i = 0; i < first_waiting + 2 * kContrasted; ++i) {
    const Reading& reading = waiting_[i].reading;
    turn_known = turn_known && reading.has_turn && !reading.turn.begins_segment;
    turned_rad += std::abs(reading.turn.measured_angle_rad);
  }
  const Eigen::Vector3d field = before.head<3>(), down = before.tail<3>();
  if (down.isZero(0)) return std::nullopt;
  // The interval lies between the two means. Readings left out in between count by their number.
  const double between = static_cast<double>(waiting_[first_waiting].number - onset + 2 * kContrasted);
  const double turn_std_rad =
      turn_known ? turned_rad + kGyroBias_rad_s * kUsualInterval_s * between : kUnknownTurn_rad;
  const double tilt_std_rad = (after.tail<3>() - down).norm() + kTilt_rad;
  const double noise_uT = now_.predictor.noise().field_uT;
  const Eigen::Vector3d by_turn = turn_std_rad * down.cross(field), moving = (after - first).head<3>();
  FieldContrast found;
  found.size_uT = after.head<3>() - field;
  found.std_uT =
      (by_turn.array().square() + moving.array().square() +
       tilt_std_rad * tilt_std_rad * (field.squaredNorm() - field.array().square()) + noise_uT * noise_uT)
          .sqrt();
  return found;
}

bool Magnetometer::is_field_before() const {
  if (!before_) return false;
  // The criterion is that of the watch: readings less than two standard deviations off in the mean, by a fit
  // that is accurate there.
  constexpr double kFits = 4;
  double sum = 0;
  std::size_t known = 0;
  for (const Waiting& waiting : waiting_) {
    const auto exact = before_->predictor.exact(waiting.predicted);
    sum += std::min(exact.surprise, 25.0);
    if (exact.known) ++known;
  }
  return sum < kFits * static_cast<double>(waiting_.size()) && 2 * known > waiting_.size();
}

void Magnetometer::use_waiting() {
  watch_.reset();
  past_.clear();
  turn_broken_ = true;
  for (const Waiting& waiting : waiting_) use(waiting);
  waiting_.clear();
  next_decision_ = 0;
}

void Magnetometer::change_field(const FieldStep& found) {
  if (is_elsewhere_ && is_field_before()) {  // back at the place before
    history_.begin_place();
    now_ = *std::exchange(before_, std::nullopt);
    is_elsewhere_ = false;
    ++moves_;
    return use_waiting();
  }
  FieldStep step = found;
  const auto last = last_step();
  // The fit of a field that was seen from one side only does not tell whether a reading is of it.
  const bool cancels = before_ && last && (last->size_uT + step.size_uT).norm() < kCancelled * step.size_uT.norm();
  step.returned = cancels || is_field_before();
  refine_history(step.returned);
  if (step.returned && last && last->std_uT.norm() < step.std_uT.norm()) {
    step.size_uT = -last->size_uT;
    step.std_uT = last->std_uT;
  }
  history_.begin_segment(step);
  Estimators next = step.returned ? *before_ : Estimators(parameters_);
  before_ = now_;
  now_ = std::move(next);
  is_elsewhere_ = false;
  ++field_steps_;
  use_waiting();
}

}  // namespace navcal::calib
