// SPDX-License-Identifier: Apache-2.0
#include "gap/verdict/sources.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "gap/sources/source_evidence.h"
#include "gap/thresholds.h"

namespace navcal::gap {
namespace {

SourceFinding finding_of(const SourceFit& fit, const std::vector<Covariate>& covariates) {
  SourceFinding finding{std::string(fit.source->name), std::string(fit.source->words), fit.gain_nats, {}};
  for (const ErrorTerm& term : fit.terms) {
    const Covariate& covariate = covariates[term.covariate];
    const ErrorComponent& component = *term.component;
    finding.errors.push_back({std::string(component.name),
                              std::string(component.channel),
                              std::string(covariate.regime),
                              covariate.name,
                              {covariate.families.begin(), covariate.families.end()},
                              component.per_si * term.coefficient,
                              component.per_si * term.std_error,
                              std::string(component.unit)});
  }
  return finding;
}

/// The sources of one recording by itself.
std::vector<SourceFinding> sources_of(const Prepared& recording, const DiagnosisProblem& problem,
                                      const Linearised& nominal, const Priors& priors, CovariateSet set) {
  const std::vector<Covariate> covariates = covariates_of(recording.course);
  const ResidualModel model = recording.model(problem.library, problem.threads);
  const SourceProblem of{model, nominal, priors, covariates, recording.course.time_s.front()};
  std::vector<SourceFinding> findings;
  for (const SourceFit& fit :
       rank_sources(of, set, [&](double done) { problem.progress("looking for the source", done); })) {
    findings.push_back(finding_of(fit, covariates));
  }
  return findings;
}

}  // namespace

void write_sources(const DiagnosisProblem& problem, const FoundEffects& found, Diagnosis& answer) {
  const CovariateSet set = answer.verdict == Verdict::unknown ? CovariateSet::full : CovariateSet::basic;
  // What was linearised for several recordings together has left out their biases.
  const auto of = [&](const Prepared& recording) {
    return sources_of(recording, problem,
                      linearise(recording.model(problem.library, problem.threads), recording.at), found.priors,
                      set);
  };
  answer.sources = problem.others.empty() ? sources_of(problem.prepared, problem, found.nominal, found.priors, set)
                                          : of(problem.prepared);
  for (const Prepared* other : problem.others) {
    for (SourceFinding& finding : of(*other)) {
      const auto same = std::find_if(answer.sources.begin(), answer.sources.end(),
                                     [&](const SourceFinding& each) { return each.name == finding.name; });
      if (same == answer.sources.end()) {
        answer.sources.push_back(std::move(finding));
      } else {
        same->gain_nats += finding.gain_nats;
      }
    }
  }
  std::stable_sort(answer.sources.begin(), answer.sources.end(),
                   [](const SourceFinding& a, const SourceFinding& b) { return a.gain_nats > b.gain_nats; });
}

void put_source_first(Diagnosis& answer) {
  if (answer.sources.empty() || answer.sources.front().gain_nats < kObservable_nats) return;
  const SourceFinding& source = answer.sources.front();
  const ErrorFinding& error = source.errors.front();
  if (error.channel.empty()) return;
  const auto is_there = [&](const WhereEntry& entry) { return entry.channel == error.channel; };
  if (std::none_of(answer.where.begin(), answer.where.end(), is_there)) {
    // Where the data are noise, evidence of exp(g) has at most the probability exp(-g) (Markov's inequality).
    answer.where.insert(answer.where.begin(), {error.channel, error.regime, std::abs(error.rms), error.std_error,
                                               error.unit, std::exp(-source.gain_nats)});
    return;
  }
  std::stable_partition(answer.where.begin(), answer.where.end(), is_there);
}

}  // namespace navcal::gap
