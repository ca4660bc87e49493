// SPDX-License-Identifier: Apache-2.0
#include "tests/gap/design/planned_question.h"

#include "tests/gap/prepared_mission.h"

namespace navcal::gap::test {

PlannedQuestion::PlannedQuestion(const std::vector<std::string>& effects)
    : effects_(effects), library_({}),
      prepared_(prepared_mission({.mission = "survey", .effects = "", .seconds = 50}, library_, {12, 1, 2})) {}

Question PlannedQuestion::question(MissionPurpose purpose) const {
  const NullBank& bank = prepared_->bank;
  const Priors priors = fit_spike_widths(library_, bank.gram, bank.scores);
  Question question;
  question.purpose = purpose;
  ask_about(library_, priors, question);
  question.so_far = {bank.gram, coverage_of(prepared_->course)};
  const auto n = static_cast<Eigen::Index>(library_.unknowns().size());
  const Information nothing{Eigen::MatrixXd::Zero(n, n), Eigen::VectorXd::Zero(n)};
  const double share = 1.0 / static_cast<double>(effects_.size() + 1);
  for (const std::string& name : effects_) {
    const EffectSubset set{index_of(library_, name)};
    Hypothesis hypothesis = make_hypothesis(set, share, nothing, library_, priors);
    for (const Eigen::Index j : parameter_indices(library_, set)) {
      hypothesis.mean[j] = library_.unknowns()[static_cast<std::size_t>(j)].typical;
    }
    question.hypotheses.push_back(std::move(hypothesis));
  }
  question.hypotheses.push_back(make_hypothesis({}, share, nothing, library_, priors));
  return question;
}

}  // namespace navcal::gap::test
