// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/recording_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "diagnosis/limits.h"

namespace navcal::diagnosis {
namespace {

/// Factor of 1 + root^T information root.
Eigen::LLT<Eigen::MatrixXd> factor_of(const Eigen::MatrixXd& information, const Eigen::MatrixXd& root) {
  Eigen::MatrixXd scaled = root.transpose() * information * root;
  scaled.diagonal().array() += 1;
  return Eigen::LLT<Eigen::MatrixXd>(scaled);
}

}  // namespace

double Likelihood::evidence() const {
  if (std::isinf(freedom)) return value;
  return norm - (freedom + 1) / 2 * std::log1p(2 * std::max(norm - value, 0.0) / freedom);
}

Likelihood Likelihood::about(const Eigen::VectorXd& at) const {
  const Eigen::VectorXd image = information * at;
  return {information, score - image, value + score.dot(at) - at.dot(image) / 2, norm, freedom};
}

Likelihood Likelihood::blurred(const Eigen::MatrixXd& root) const {
  const auto factor = factor_of(information, root);
  // With F F^T the factored matrix: |F^-1 root^T (score - information x)|^2 / 2 is added.
  const Eigen::VectorXd of_score = factor.matrixL().solve(root.transpose() * score);
  const Eigen::MatrixXd of_information = factor.matrixL().solve(root.transpose() * information);
  const double log_root = factor.matrixLLT().diagonal().array().log().sum();
  return {information - of_information.transpose() * of_information, score - of_information.transpose() * of_score,
          value + of_score.squaredNorm() / 2 - log_root, norm - log_root, freedom};
}

Likelihood Likelihood::tempered(double factor) const {
  return {information / factor, score / factor, norm + (value - norm) / factor, norm, freedom};
}

double RecordingFit::damping() const { return std::max(1.0, mean_square / kLinearPower); }

bool RecordingFit::is_astray() const { return mean_square > kAstrayPower; }

Likelihood RecordingFit::guide() const { return linear.tempered(damping()); }

Likelihood Likelihood::of(const std::vector<Eigen::Index>& columns) const {
  return {information(columns, columns), score(columns), value, norm, freedom};
}

Likelihood& Likelihood::operator+=(const Likelihood& other) {
  information += other.information;
  score += other.score;
  value += other.value;
  norm += other.norm;
  return *this;
}

Likelihood side_by_side(std::span<const Likelihood> recordings) {
  const Eigen::Index own = recordings.front().score.size(), all = own * std::ssize(recordings);
  Likelihood joined{.information = Eigen::MatrixXd::Zero(all, all), .score = Eigen::VectorXd(all)};
  joined.freedom = recordings.front().freedom;
  Eigen::Index at = 0;
  for (const Likelihood& one : recordings) {
    joined.information.block(at, at, own, own) = one.information;
    joined.score.segment(at, own) = one.score;
    joined.value += one.value;
    joined.norm += one.norm;
    at += own;
  }
  return joined;
}

Eigen::MatrixXd covariance_of(const Eigen::MatrixXd& information, const Eigen::VectorXd& stds) {
  return stds.asDiagonal() * factor_of(information, stds.asDiagonal()).solve(Eigen::MatrixXd(stds.asDiagonal()));
}

Likelihood JointPrior::of_changes(const Likelihood& likelihood) const {
  Likelihood all = likelihood.about(mean).blurred(root);
  if (recordings == 1) return all;
  const Eigen::Index own = mean.size() / recordings;
  const Eigen::MatrixXd alike = Eigen::MatrixXd::Identity(own, own).replicate(recordings, 1);
  return {alike.transpose() * all.information * alike, alike.transpose() * all.score, all.value, all.norm,
          all.freedom};
}

Eigen::VectorXd JointPrior::posterior_mean(const Likelihood& likelihood) const {
  const Eigen::VectorXd score = root.transpose() * (likelihood.score - likelihood.information * mean);
  return mean + root * factor_of(likelihood.information, root).solve(score);
}

std::invalid_argument cannot_follow(const identify::RecordedMotion& recording) {
  return std::invalid_argument(recording.name + ": the layout cannot follow it: is it this vehicle's?");
}

std::optional<double> RecordingModel::log_likelihood(const Eigen::VectorXd& at) const {
  const auto here = fit(at);
  if (!here) return std::nullopt;
  return here->linear.about(at).value;
}

Eigen::VectorXd values_within(const CauseLibrary& library, const Eigen::VectorXd& start,
                              const Eigen::VectorXd& at) {
  Eigen::VectorXd values = start + at;
  for (std::size_t i = 0; i < library.parameters.size(); ++i) {
    double& value = values[static_cast<Eigen::Index>(i)];
    value = std::clamp(value, library.parameters[i].low, library.parameters[i].high);
  }
  return values;
}

FittedRecording::FittedRecording(const config::Layout& layout, const CauseLibrary& library,
                                 identify::RecordedMotion recording, const identify::FilterNoises& noises,
                                 unsigned threads)
    : library_(library), recorded_(std::move(recording)),
      filter_(layout, library.parameters, recorded_, noises, threads),
      columns_(static_cast<std::size_t>(library.columns())) {
  std::iota(columns_.begin(), columns_.end(), Eigen::Index{0});
  filter_.leave_out_diverging(filter_.start());
}

std::optional<identify::FilterPass> FittedRecording::follow(const Eigen::VectorXd& at) const {
  return filter_.follow(values_at(at));
}

bool FittedRecording::hold(const Eigen::VectorXd& at) {
  auto pass = follow(at);
  if (pass) held_ = std::move(pass);
  return pass.has_value();
}

std::optional<identify::FilterLinearised> FittedRecording::linearised(
    const Eigen::VectorXd& at, std::span<const Eigen::Index> columns) const {
  if (held_) return filter_.linearise(*held_, values_at(at), columns);
  const auto pass = follow(at);
  if (!pass) return std::nullopt;
  return filter_.linearise(*pass, columns);
}

std::optional<double> FittedRecording::log_likelihood(const Eigen::VectorXd& at) const {
  const auto here = linearised(at, {});
  if (!here) return std::nullopt;
  return -(here->power + here->log_det) / 2;
}

std::optional<RecordingFit> FittedRecording::fit(const Eigen::VectorXd& at) const {
  const auto here = linearised(at);
  if (!here) return std::nullopt;
  const Eigen::VectorXd inside = within(at);
  const Likelihood linear{here->information(), here->score(), -(here->power + here->log_det) / 2,
                          -here->log_det / 2};
  return RecordingFit{linear.about(-inside), inside, here->power / static_cast<double>(here->count())};
}

std::optional<RecordingPower> FittedRecording::power(const Eigen::VectorXd& at) const {
  const auto pass = follow(at);
  return pass ? std::optional(power_of(*pass)) : std::nullopt;
}

RecordingPower FittedRecording::power_of(const identify::FilterPass& pass) const {
  RecordingPower power;
  power.mean_square = pass.mean_square();
  std::array<double, identify::kChannels> squares{};
  auto& counts = power.readings_of_channel;
  for (std::size_t i = 0; i < pass.readings.size(); ++i) {
    if (pass.readings[i].is_settling) continue;
    const auto& reading = filter_.readings()[i];
    const double square = pass.readings[i].white * pass.readings[i].white;
    const auto channel = static_cast<std::size_t>(reading.channel);
    squares[channel] += std::min(square, kWild_sigma * kWild_sigma);
    counts[channel] += 1;
    const auto block = static_cast<std::size_t>(std::max(reading.time_s, 0.0) / kBlock_s);
    power.of_block.resize(std::max(power.of_block.size(), block + 1));
    power.readings.resize(power.of_block.size());
    power.of_block[block] += square;
    power.readings[block] += 1;
  }
  for (std::size_t c = 0; c < identify::kChannels; ++c)
    power.of_channel[c] = counts[c] > 0 ? squares[c] / counts[c] : -1;
  return power;
}

Eigen::VectorXd JoinedRecordings::of_part(const Eigen::VectorXd& at, std::size_t part) const {
  const Eigen::Index own = at.size() / std::ssize(parts_);
  return at.segment(own * static_cast<Eigen::Index>(part), own);
}

Eigen::VectorXd JoinedRecordings::within(const Eigen::VectorXd& at) const {
  Eigen::VectorXd inside(at.size());
  const Eigen::Index own = at.size() / std::ssize(parts_);
  for (std::size_t i = 0; i < parts_.size(); ++i)
    inside.segment(own * static_cast<Eigen::Index>(i), own) = parts_[i]->within(of_part(at, i));
  return inside;
}

std::optional<RecordingFit> JoinedRecordings::fit(const Eigen::VectorXd& at) const {
  std::vector<Likelihood> linear;
  Eigen::VectorXd inside(at.size());
  double mean_square = 0;
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    auto one = parts_[i]->fit(of_part(at, i));
    if (!one) return std::nullopt;
    inside.segment(one->at.size() * static_cast<Eigen::Index>(i), one->at.size()) = one->at;
    linear.push_back(std::move(one->linear));
    mean_square = std::max(mean_square, one->mean_square);
  }
  return RecordingFit{side_by_side(linear), std::move(inside), mean_square};
}

std::optional<double> JoinedRecordings::log_likelihood(const Eigen::VectorXd& at) const {
  double sum = 0;
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const auto one = parts_[i]->log_likelihood(of_part(at, i));
    if (!one) return std::nullopt;
    sum += *one;
  }
  return sum;
}

std::optional<RecordingPower> JoinedRecordings::power(const Eigen::VectorXd& at) const {
  RecordingPower all;
  double squares = 0, readings = 0;
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const auto one = parts_[i]->power(of_part(at, i));
    if (!one) return std::nullopt;
    for (std::size_t c = 0; c < identify::kChannels; ++c) {
      all.of_channel[c] += std::max(one->of_channel[c], 0.0) * one->readings_of_channel[c];
      all.readings_of_channel[c] += one->readings_of_channel[c];
      readings += one->readings_of_channel[c];
      squares += one->mean_square * one->readings_of_channel[c];
    }
    all.of_block.insert(all.of_block.end(), one->of_block.begin(), one->of_block.end());
    all.readings.insert(all.readings.end(), one->readings.begin(), one->readings.end());
  }
  for (std::size_t c = 0; c < identify::kChannels; ++c)
    all.of_channel[c] = all.readings_of_channel[c] > 0 ? all.of_channel[c] / all.readings_of_channel[c] : -1;
  all.mean_square = squares / readings;
  return all;
}

bool JoinedRecordings::hold(const Eigen::VectorXd& at) {
  bool any = false;
  for (std::size_t i = 0; i < parts_.size(); ++i) any = parts_[i]->hold(of_part(at, i)) || any;
  return any;
}

std::unique_ptr<RecordingModel> FilteredSource::nominal(const identify::RecordedMotion& recording) {
  auto made = fitted(recording);
  nominals_.push_back(made.get());
  return made;
}

void FilteredSource::refine(std::size_t round, std::span<const Eigen::VectorXd> at) {
  if (round < kNoiseRounds) {
    std::vector<identify::FilterPass> passes;
    std::vector<identify::FollowedRecording> of_noise;
    const std::size_t count = std::min(nominals_.size(), kNoiseFrom);
    for (std::size_t i = 0; i < count; ++i) {
      auto pass = nominals_[i]->follow(at[i]);
      if (!pass) throw cannot_follow(nominals_[i]->recording());
      passes.push_back(std::move(*pass));
    }
    for (std::size_t i = 0; i < count; ++i) of_noise.push_back({&nominals_[i]->filter(), &passes[i]});
    noises_ = identify::fit_noises(of_noise, noises_, threads_).noises;
    correlation_ = identify::least_correlation(of_noise, noises_);
  }
  for (FittedRecording* one : nominals_) one->filter().set_noises(noises_);
}

std::vector<RecordingPower> FilteredSource::nominal_powers(std::span<const Eigen::VectorXd> at) const {
  std::vector<identify::FilterPass> passes;
  std::vector<const FittedRecording*> followed;
  for (std::size_t i = 0; i < at.size(); ++i) {
    if (auto pass = nominals_[i]->follow(at[i])) {
      passes.push_back(std::move(*pass));
      followed.push_back(nominals_[i]);
    }
  }
  std::vector<RecordingPower> powers;
  for (std::size_t i = 0; i < passes.size(); ++i) {
    std::vector<identify::FollowedRecording> others;
    for (std::size_t k = 0; k < passes.size() && others.size() < kNoiseFrom; ++k)
      if (k != i) others.push_back({&followed[k]->filter(), &passes[k]});
    identify::FilterPass apart = passes[i];
    if (!others.empty())
      followed[i]->filter().filter_again(passes[i], identify::fit_noises(others, noises_, threads_).noises,
                                         apart.readings);
    powers.push_back(followed[i]->power_of(apart));
  }
  return powers;
}

std::optional<double> FilteredSource::thin() {
  if (correlation_ < identify::kDependent || interval_ + 1 == identify::kIntervals_s.size()) return std::nullopt;
  nominals_.clear();
  return identify::kIntervals_s[++interval_];
}

std::unique_ptr<RecordingModel> FilteredSource::compared(const identify::RecordedMotion& recording,
                                                         const Eigen::VectorXd& nominal) const {
  auto made = fitted(recording);
  if (!made->hold(nominal)) throw cannot_follow(recording);
  return made;
}

Leads FilteredSource::leads() const { return {kGap_nats, kNamed_nats, kClass_nats, kFaint_nats, {}, false}; }

}  // namespace navcal::diagnosis
