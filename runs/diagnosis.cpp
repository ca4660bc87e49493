// SPDX-License-Identifier: Apache-2.0
#include "runs/diagnosis.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/enum_name.h"
#include "base/square.h"
#include "base/statistics.h"

namespace navcal::runs {
namespace {

/// The spectrum's scatter rests on bands and runs together, tens of degrees of freedom.
constexpr double kSpectrumDegrees = 20;
/// Relative standard deviation of the height of a line.
constexpr double kLineSpread = 0.4;
/// Standard deviations of the shapes of a line: what the window leaves, and twice that for a rate that wanders.
constexpr double kLineWidths_Hz[] = {0.15, 0.3};

double log_determinant(const Eigen::LLT<Eigen::MatrixXd>& factor) {
  return 2 * factor.matrixLLT().diagonal().array().log().sum();
}

/// A verdict needs this probability: a wrong one costs a needless repair or an unsafe dive.
constexpr double kProbabilityOfVerdict = 0.8;

struct Weighed {
  const Hypothesis* hypothesis;
  double probability;
};

std::vector<Weighed> weighed(RunEvidence& evidence, std::span<const Hypothesis> all) {
  std::vector<double> logs;
  for (const Hypothesis& hypothesis : all) {
    logs.push_back(std::log(hypothesis.prior) + evidence.log_evidence(hypothesis));
  }
  const double whole = base::log_sum_exp(logs);
  std::vector<Weighed> found;
  for (std::size_t i = 0; i < all.size(); ++i) found.push_back({&all[i], std::exp(logs[i] - whole)});
  std::ranges::stable_sort(found, std::greater{}, &Weighed::probability);
  return found;
}

Candidate candidate_of(const Weighed& found) {
  const Hypothesis& hypothesis = *found.hypothesis;
  if (hypothesis.effect != nullptr) return {std::string(hypothesis.effect->name), found.probability};
  return {std::string(verdict_name(hypothesis.unknown ? Verdict::unknown : Verdict::nominal)), found.probability};
}

/// Members of the family of the most probable effect, when together they are probable enough.
std::vector<Candidate> family_of(const std::vector<Weighed>& found) {
  const auto first =
      std::ranges::find_if(found, [](const Weighed& one) { return one.hypothesis->effect != nullptr; });
  if (first == found.end()) return {};
  std::vector<Candidate> members;
  double probability = 0;
  for (const Weighed& one : found) {
    if (one.hypothesis->effect == nullptr || one.hypothesis->effect->family != first->hypothesis->effect->family)
      continue;
    members.push_back(candidate_of(one));
    probability += one.probability;
  }
  if (probability < kProbabilityOfVerdict) return {};
  return members;
}

void judge(const std::vector<Weighed>& found, RunDiagnosis& diagnosis) {
  const Weighed& best = found.front();
  if (best.probability < kProbabilityOfVerdict) {
    diagnosis.effects = family_of(found);
    diagnosis.verdict = diagnosis.effects.empty() ? Verdict::undecided : Verdict::explained;
  } else if (best.hypothesis->effect != nullptr) {
    diagnosis.effects = {candidate_of(best)};
    diagnosis.verdict = Verdict::explained;
  } else {
    diagnosis.verdict = best.hypothesis->unknown ? Verdict::unknown : Verdict::nominal;
  }
}

}  // namespace

double log_student(double squared, double log_determinant, double dimension, double degrees) {
  return -0.5 * log_determinant - 0.5 * (degrees + dimension) * std::log1p(squared / degrees);
}

RunEvidence::RunEvidence(const NominalVehicle& vehicle, std::span<const Response> responses)
    // The tolerances count as much as the sessions that were seen.
    : vehicle_(vehicle), degrees_(std::max(3.0, 2 * static_cast<double>(vehicle.parameters.sessions))) {
  take_parameters(responses);
  take_spectrum(responses);
}

void RunEvidence::take_parameters(std::span<const Response> responses) {
  all_deviations_.setConstant(std::numeric_limits<double>::quiet_NaN());
  all_deviations_std_ = all_deviations_;
  std::vector<double> counts;
  const Scatter& nominal = vehicle_.parameters;
  for (Eigen::Index i = 0; i < kParameterCount; ++i) {
    double sum = 0, count = 0;
    for (const Response& response : responses) {
      if (std::isnan(response.parameters[i])) continue;
      sum += response.parameters[i];
      ++count;
    }
    if (count == 0) continue;
    shown_.push_back(i);
    counts.push_back(count);
    all_deviations_[i] = sum / count - nominal.mean[i];
    all_deviations_std_[i] = std::sqrt(nominal.session(i, i) + nominal.run(i, i) / count);
  }
  const auto n = static_cast<Eigen::Index>(shown_.size());
  deviations_.resize(n);
  covariance_.resize(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto place = static_cast<std::size_t>(i);
    deviations_[i] = all_deviations_[shown_[place]];
    for (Eigen::Index j = 0; j < n; ++j) {
      const auto other = static_cast<std::size_t>(j);
      covariance_(i, j) = nominal.session(shown_[place], shown_[other]) +
                          nominal.run(shown_[place], shown_[other]) / std::sqrt(counts[place] * counts[other]);
    }
  }
}

void RunEvidence::take_spectrum(std::span<const Response> responses) {
  if (!vehicle_.spectrum) return;
  double count = 0;
  Eigen::VectorXd mean_dB = Eigen::VectorXd::Zero(vehicle_.spectrum->mean.size());
  for (const Response& response : responses) {
    if (!response.spectrum_dB) continue;
    mean_dB += *response.spectrum_dB;
    ++count;
  }
  if (count == 0) return;
  const Eigen::MatrixXd& free = vehicle_.without_shape;
  const Eigen::MatrixXd scatter = free * (vehicle_.spectrum->session + vehicle_.spectrum->run / count) * free;
  // What was taken out of the spectra has no variance there: a unit variance keeps the covariance regular, and no
  // deviation meets it.
  spectrum_factor_ = Eigen::MatrixXd(scatter + Eigen::MatrixXd::Identity(free.rows(), free.cols()) - free).llt();
  spectrum_ = spectrum_factor_->matrixL().solve(free * (mean_dB / count) - vehicle_.spectrum->mean);
  spectrum_log_determinant_ = log_determinant(*spectrum_factor_);
}

double RunEvidence::of_parameters(const Prediction& prediction) const {
  const auto n = static_cast<Eigen::Index>(shown_.size());
  if (n == 0) return 0;
  Eigen::MatrixXd covariance = covariance_;
  Eigen::VectorXd off = deviations_;
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Index parameter = shown_[static_cast<std::size_t>(i)];
    covariance(i, i) += base::square(prediction.spread[parameter]);
    off[i] -= prediction.shift[parameter];
  }
  const Eigen::LLT<Eigen::MatrixXd> factor(covariance);
  return log_student(factor.matrixL().solve(off).squaredNorm(), log_determinant(factor), static_cast<double>(n),
                     degrees_);
}

/// A line at each frequency and of each width is as probable. Its height is uncertain, which adds a matrix of rank
/// one to the covariance: its determinant and inverse follow from Sherman and Morrison's formula.
double RunEvidence::with_line(double height_dB) const {
  const Eigen::Index bands = spectrum_.size();
  std::vector<double> logs;
  for (Eigen::Index centre = 1; centre + 1 < bands; ++centre) {
    for (const double width_Hz : kLineWidths_Hz) {
      Eigen::VectorXd shape(bands);
      for (Eigen::Index band = 0; band < bands; ++band) {
        const double apart = static_cast<double>(band - centre) * kBandWidth_Hz / width_Hz;
        shape[band] = std::exp(-0.5 * apart * apart);
      }
      const Eigen::VectorXd line = spectrum_factor_->matrixL().solve(vehicle_.without_shape * shape);
      const Eigen::VectorXd left = spectrum_ - height_dB * line;
      const double variance = base::square(kLineSpread * height_dB), size = 1 + variance * line.squaredNorm();
      logs.push_back(log_student(left.squaredNorm() - variance * base::square(line.dot(left)) / size,
                                 spectrum_log_determinant_ + std::log(size), static_cast<double>(bands),
                                 kSpectrumDegrees));
    }
  }
  return base::log_mean_exp(logs);
}

double RunEvidence::of_spectrum(const Prediction& prediction) {
  if (!spectrum_factor_) return 0;
  const double without = log_student(spectrum_.squaredNorm(), spectrum_log_determinant_,
                                     static_cast<double>(spectrum_.size()), kSpectrumDegrees);
  if (!prediction.line_dB) return without;
  auto known = with_line_.find(*prediction.line_dB);
  if (known == with_line_.end()) {
    known = with_line_.emplace(*prediction.line_dB, with_line(*prediction.line_dB)).first;
  }
  if (prediction.line_shows >= 1) return known->second;
  const double both[] = {std::log(prediction.line_shows) + known->second,
                         std::log1p(-prediction.line_shows) + without};
  return base::log_sum_exp(both);
}

double RunEvidence::log_evidence(const Hypothesis& hypothesis) {
  std::vector<double> logs;
  for (const Prediction& prediction : hypothesis.predictions) {
    logs.push_back(of_parameters(prediction) + of_spectrum(prediction));
  }
  return base::log_mean_exp(logs);
}

std::string_view verdict_name(Verdict verdict) {
  return base::enum_name<Verdict::undecided>(verdict, {"no-gap", "explained", "unknown", "undecided"});
}

RunDiagnosis diagnose(const NominalVehicle& vehicle, std::span<const Response> responses,
                      const EffectInformation* removed) {
  std::vector<Response> driven;
  std::ranges::copy_if(responses, std::back_inserter(driven), &Response::driven);
  RunDiagnosis diagnosis;
  diagnosis.runs_used = driven.size();
  RunEvidence evidence(vehicle, driven);
  diagnosis.deviations = evidence.deviations();
  diagnosis.standard_deviations = evidence.standard_deviations();
  const Scatter& nominal = vehicle.parameters;
  const ParameterVector scatter = (nominal.session.diagonal() + nominal.run.diagonal()).cwiseSqrt();
  const std::vector<Hypothesis> all = hypotheses(scatter, removed);
  const std::vector<Weighed> found = weighed(evidence, all);
  for (const Weighed& one : found) diagnosis.candidates.push_back(candidate_of(one));
  if (!driven.empty()) judge(found, diagnosis);
  return diagnosis;
}

}  // namespace navcal::runs
