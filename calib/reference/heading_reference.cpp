// SPDX-License-Identifier: Apache-2.0
#include "calib/reference/heading_reference.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "base/angles.h"
#include "base/symmetric_solve.h"
#include "calib/coverage.h"
#include "calib/gps/gps_coefficients.h"

namespace navcal::calib {
namespace {

constexpr double kModelBlocks = 10;  ///< share of the model's own covariance, in blocks
constexpr double kMostMemory = 0.9;  ///< coefficient of an autoregression from which on it is no longer stable
constexpr int kCircle = 72;          ///< headings at which the uncertainty is evaluated

std::string degrees_of(double angle_rad) {
  return std::to_string(std::lround(std::ceil(angle_rad * base::kDegreesPerRadian)));
}

}  // namespace

void HeadingReference::Block::add(const Block& other) {
  information += other.information;
  right += other.right;
  square += other.square;
}

HeadingReference::Block& HeadingReference::block_at(double time_s) {
  const bool is_new = blocks_.empty() || time_s >= blocks_.back().begin_s + block_s_;
  if (is_new && blocks_.size() == kMostBlocks) {
    for (std::size_t i = 0; i < kMostBlocks / 2; ++i) {
      blocks_[i] = blocks_[2 * i];
      blocks_[i].add(blocks_[2 * i + 1]);
    }
    blocks_.resize(kMostBlocks / 2);
    block_s_ *= 2;
  }
  if (is_new) blocks_.emplace_back().begin_s = time_s;
  return blocks_.back();
}

void HeadingReference::update(const HeadingPair& pair) {
  const double difference_rad = pair.heading_rad - pair.reference_rad;
  if (pairs_ == 0) about_rad_ = std::remainder(difference_rad, base::kTurn_rad);
  const double y = std::remainder(difference_rad - about_rad_, base::kTurn_rad);
  const double variance = pair.variance_rad2 + parameters_.heading_noise_rad * parameters_.heading_noise_rad;
  Vector row;
  row << deviation_harmonics(pair.heading_rad), pair.rate_rad_s;
  const Matrix product = row * row.transpose();
  Block& block = block_at(pair.time_s);
  block.information += product / variance;
  block.right += row * (y / variance);
  block.square += y * y / variance;
  ++rose_[sector_of(pair.heading_rad)];
  time_variance_s2_ += pair.time_std_s * pair.time_std_s;
  ++pairs_;
}

HeadingReference::Matrix HeadingReference::score_covariance(const Vector& x) const {
  std::array<Vector, kMostBlocks> scores;
  Vector square = Vector::Zero(), product = Vector::Zero();
  for (std::size_t i = 0; i < blocks_.size(); ++i) {
    scores[i] = blocks_[i].right - blocks_[i].information * x;
    square += scores[i].cwiseAbs2();
    if (i > 0) product += scores[i].cwiseProduct(scores[i - 1]);
  }
  const auto blocks = static_cast<double>(blocks_.size());
  Vector memory;
  for (int i = 0; i < kUnknowns; ++i) {
    const double found = square[i] > 0 ? product[i] / square[i] : 0;
    memory[i] = std::clamp((blocks * found + 1) / (blocks - 4), 0.0, kMostMemory);
  }
  Matrix sum = Matrix::Zero();
  for (std::size_t i = 1; i < blocks_.size(); ++i) {
    const Vector innovation = scores[i] - memory.cwiseProduct(scores[i - 1]);
    sum += innovation * innovation.transpose();
  }
  const Vector gain = (Vector::Ones() - memory).cwiseInverse();
  return gain.asDiagonal() * sum * gain.asDiagonal() * (blocks / (blocks - 1));
}

std::optional<HeadingReference::Estimate> HeadingReference::estimate(double declination_rad) const {
  if (pairs_ < parameters_.least_pairs) return std::nullopt;
  Block all;
  for (const Block& block : blocks_) all.add(block);
  const auto pairs = static_cast<double>(pairs_);
  constexpr double kLeastTime_s2 = 1e-8;
  Vector prior = Vector::Constant(1 / (parameters_.deviation_std_rad * parameters_.deviation_std_rad));
  prior[0] = 0;
  prior[5] = 1 / std::max(time_variance_s2_ / pairs, kLeastTime_s2);
  Matrix information = all.information;
  information.diagonal() += prior;
  const Matrix inverse = base::inverse_symmetric(information);
  const Vector x = inverse * all.right;
  if (!x.allFinite()) return std::nullopt;
  const double square = all.square - 2 * x.dot(all.right) + x.dot(all.information * x);
  const Matrix model = inverse * std::max(1.0, square / pairs);
  Estimate estimate;
  const auto blocks = static_cast<double>(blocks_.size());
  estimate.covariance = model * std::max(1.0, kModelBlocks / blocks);
  if (blocks > kModelBlocks) {
    Matrix scores = score_covariance(x) * (blocks / (blocks - kUnknowns));
    scores.diagonal() += prior;
    const Matrix scatter = inverse * scores * inverse;
    estimate.covariance = scatter + model * (kModelBlocks / blocks);
  }
  // The first element of the information is the sum of the weights.
  estimate.residual_rad = std::sqrt(std::max(0.0, square) / all.information(0, 0));
  estimate.coefficients = x;
  estimate.coefficients[0] = std::remainder(x[0] + about_rad_ + declination_rad, base::kTurn_rad);
  for (int i = 0; i < kCircle; ++i) {
    const double heading_rad = base::kTurn_rad * i / kCircle;
    const auto row = deviation_harmonics(heading_rad);
    const double std_rad = std::sqrt(std::max(0.0, row.dot(estimate.covariance.topLeftCorner<5, 5>() * row)));
    if (std_rad <= estimate.worst_std_rad) continue;
    estimate.worst_std_rad = std_rad;
    estimate.worst_heading_rad = heading_rad;
  }
  return estimate;
}

Judgement HeadingReference::judgement(double declination_rad) const {
  Judgement judgement;
  judgement.samples = pairs_;
  judgement.coverage = static_cast<double>(visited(rose_)) / static_cast<double>(rose_.size());
  judgement.condition = std::numeric_limits<double>::infinity();
  const auto found = estimate(declination_rad);
  if (!found) {
    return judgement.refused(pairs_ == 0 ? "no heading of the compass at the time of a reference so far"
                                         : "too few headings of the reference",
                             "turn through all headings while the reference is in sight");
  }
  const Vector& x = found->coefficients;
  const double removed_rad = std::sqrt(x[0] * x[0] + x.segment<4>(1).squaredNorm() / 2);
  const double least_rad2 = found->covariance.diagonal().head<5>().minCoeff();
  judgement.condition = found->worst_std_rad / std::sqrt(std::max(least_rad2, 1e-300));
  if (blocks_.size() < kLeastBlocks && block_s_ == kFirstBlock_s) {
    return judgement.refused("the reference was in sight for less than " +
                                 std::to_string(std::lround(kFirstBlock_s * kLeastBlocks)) +
                                 " s, too short to know how long its errors last",
                             "go on through all headings while the reference is in sight");
  }
  judgement.accepted = found->worst_std_rad <= accepted_heading_std_rad(parameters_.accepted_std_rad, removed_rad);
  if (judgement.accepted) return judgement;
  judgement.reason = "the heading would be uncertain by " + degrees_of(found->worst_std_rad) +
                     " degrees or so at " +
                     std::to_string(std::lround(found->worst_heading_rad * base::kDegreesPerRadian));
  judgement.manoeuvre = missing_turn(rose_);
  if (judgement.manoeuvre.empty())
    judgement.manoeuvre = "go on through all headings while the reference is in sight";
  return judgement;
}

void HeadingReference::archive(Archive& archive) {
  archive.tag("heading_reference 1");
  archive(blocks_, block_s_, about_rad_, pairs_, time_variance_s2_, rose_);
  if (blocks_.size() > kMostBlocks) {
    archive.fail();
    blocks_.clear();
  }
}

}  // namespace navcal::calib
