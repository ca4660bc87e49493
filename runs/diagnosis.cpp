// SPDX-License-Identifier: Apache-2.0
#include "runs/diagnosis.h"

#include <algorithm>
#include <cmath>

#include "runs/evidence.h"

namespace navcal::runs {
namespace {

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
  const double whole = log_sum(logs);
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

std::string_view verdict_name(Verdict verdict) {
  switch (verdict) {
    case Verdict::nominal: return "no-gap";
    case Verdict::explained: return "explained";
    case Verdict::unknown: return "unknown";
    case Verdict::undecided: break;
  }
  return "undecided";
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
