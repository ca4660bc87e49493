// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/next_layout_mission.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>

#include "diagnosis/layout_rehearser.h"
#include "diagnosis/limits.h"
#include "gap/design/question.h"
#include "gap/thresholds.h"

namespace navcal::diagnosis {
namespace {

using gap::MissionPurpose;
using identify::Channel;
using identify::RecordedMotion;

/// Attitude, turning and depth of a recording; the other regimes are not measured.
gap::Coverage coverage_of(const RecordedMotion& recording) {
  gap::Trajectory10Hz course;
  const auto rows = static_cast<std::size_t>(recording.duration_s / gap::kInterval_s);
  const auto held = [&](Channel channel) {
    std::vector<double> values(rows);
    const auto& readings = recording[channel];
    std::size_t at = 0;
    for (std::size_t i = 0; i < rows && !readings.empty(); ++i) {
      while (at + 1 < readings.size() && readings[at + 1].time_s <= gap::kInterval_s * static_cast<double>(i))
        ++at;
      values[i] = readings[at].value;
    }
    return values;
  };
  for (std::size_t i = 0; i < rows; ++i) course.time_s.push_back(gap::kInterval_s * static_cast<double>(i));
  course.yaw_rate_rad_s = held(Channel::rate_z);
  course.depth_m = held(recording.has(Channel::depth) ? Channel::depth : Channel::gauge_depth);
  course.pitch_rad = held(Channel::pitch);
  course.roll_rad = held(Channel::roll);
  course.heading_rad = held(Channel::heading);
  course.shaft_rps.assign(rows, 0);
  return gap::coverage_of(course);
}

MissionPurpose purpose_of(const LayoutStudy& study) {
  const gap::Diagnosis& answer = study.diagnosis;
  if (answer.verdict == gap::Verdict::no_gap && study.found->sets.front().causes.empty())
    return MissionPurpose::sharpen;
  return answer.verdict == gap::Verdict::unknown && answer.kind == gap::UnknownKind::outside
             ? MissionPurpose::cover
             : MissionPurpose::separate;
}

/// The recordings so far as a prior of another one, for the changes that causes make: its log p is that of
/// its departures x, with x = mean + changed a + root z, z ~ N(0, 1), for changes a of all recordings alike.
struct AnotherRecording {
  Eigen::MatrixXd changed, root;

  explicit AnotherRecording(const LayoutStudy& study) {
    const Likelihood& so_far = study.found->best.linear;
    const Eigen::Index own = study.library.columns(), before = so_far.score.size();
    const JointPrior all = study.bank.prior_of(static_cast<std::size_t>(before / own + 1));
    const Eigen::MatrixXd of_before = all.root.topRows(before), of_next = all.root.bottomRows(own);
    const Eigen::MatrixXd told = of_before.transpose() * so_far.information;
    Eigen::MatrixXd precision = told * of_before;
    precision.diagonal().array() += 1;
    const Eigen::LLT<Eigen::MatrixXd> factor(precision);
    const Eigen::MatrixXd alike = Eigen::MatrixXd::Identity(own, own).replicate(before / own, 1);
    // A change that the recordings so far have as well moves what is thought of the vehicle's tolerances.
    changed = Eigen::MatrixXd::Identity(own, own) - of_next * factor.solve(told * alike);
    root = factor.matrixL().solve(of_next.transpose()).transpose();
  }

  /// Information about changes by that about departures.
  [[nodiscard]] Eigen::MatrixXd of_changes(const Eigen::MatrixXd& departures) const {
    const Likelihood here{departures, Eigen::VectorXd::Zero(departures.rows())};
    return changed.transpose() * here.blurred(root).information * changed;
  }
};

/// Columns of all causes, each once.
std::vector<Eigen::Index> cause_columns(const CauseLibrary& library) {
  std::vector<Eigen::Index> columns;
  for (const Cause& cause : library.causes)
    for (const CauseParameter& parameter : cause.parameters) columns.push_back(parameter.column);
  std::sort(columns.begin(), columns.end());
  columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
  return columns;
}

Eigen::Index place_of(Eigen::Index column, const std::vector<Eigen::Index>& columns) {
  return std::lower_bound(columns.begin(), columns.end(), column) - columns.begin();
}

/// Sets that are less behind than a cause that is named would leave them, but those that only add to another.
std::vector<gap::WeighedSet> open_sets(const LayoutStudy& study) {
  const auto& sets = study.found->sets;
  std::vector<gap::WeighedSet> open;
  for (const ScoredSet& set : sets) {
    if (set.log_odds < sets.front().log_odds - study.bank.leads.named_nats) break;
    const bool adds = std::any_of(open.begin(), open.end(), [&](const gap::WeighedSet& other) {
      return !other.effects.empty() &&
             std::includes(set.causes.begin(), set.causes.end(), other.effects.begin(), other.effects.end());
    });
    if (!adds) open.push_back({set.causes, set.probability});
  }
  return gap::weighed(open, 0);
}

gap::Hypothesis hypothesis_of(const gap::WeighedSet& set, const LayoutStudy& study,
                              const std::vector<Eigen::Index>& columns) {
  gap::Hypothesis made{set.effects, set.probability, Eigen::VectorXd::Zero(std::ssize(columns)),
                       Eigen::MatrixXd::Zero(std::ssize(columns), 1)};
  if (set.effects.empty()) return made;
  const auto estimate = SetEvidence(study.found->changes, study.library).posterior(set.effects);
  const Eigen::MatrixXd root = gap::root_of(estimate.covariance);
  made.spread = Eigen::MatrixXd::Zero(std::ssize(columns), root.cols());
  for (std::size_t i = 0; i < estimate.columns.size(); ++i) {
    const Eigen::Index at = place_of(estimate.columns[i], columns);
    made.mean[at] = estimate.mean[static_cast<Eigen::Index>(i)];
    made.spread.row(at) = root.row(static_cast<Eigen::Index>(i));
  }
  return made;
}

gap::Question question_of(const LayoutStudy& study, const std::vector<Eigen::Index>& columns) {
  gap::Question question;
  question.purpose = purpose_of(study);
  for (std::size_t i = 0; i < study.library.causes.size(); ++i) {
    question.names.push_back(study.library.causes[i].words());
    for (const CauseParameter& parameter : study.library.causes[i].parameters)
      question.tested.push_back(
          {i, parameter.name, place_of(parameter.column, columns), parameter.typical * parameter.per_unit});
  }
  for (const gap::WeighedSet& set : open_sets(study))
    question.hypotheses.push_back(hypothesis_of(set, study, columns));
  question.so_far = {study.found->changes.information(columns, columns), gap::no_coverage()};
  for (const auto* others : {&study.recordings.others, &study.recordings.holdouts})
    for (const RecordedMotion& other : *others) question.so_far.coverage += coverage_of(other);
  question.so_far.coverage += coverage_of(study.recordings.recording);
  // Tolerances are in the information already.
  question.tolerances = Eigen::VectorXd::Zero(std::ssize(columns));
  const auto next = std::make_shared<const AnotherRecording>(study);
  question.adds = [next, columns](const Eigen::MatrixXd& planned) -> Eigen::MatrixXd {
    return next->of_changes(planned)(columns, columns);
  };
  question.told_by = question.adds;
  question.unknowns = study.library.columns();
  question.named_from = 1 / (1 + std::exp(-study.bank.leads.named_nats));
  return question;
}

}  // namespace

gap::NextMission plan_next_mission(const LayoutStudy& study, const config::MissionLimits& limits,
                                   const gap::Progress& progress) {
  const auto* source = dynamic_cast<const FilteredSource*>(study.source.get());
  if (!study.found || source == nullptr) {
    throw std::invalid_argument(!study.found
                                    ? study.diagnosis.sentence
                                    : "no mission is planned for recordings that are judged by mean forces "
                                      "over steady stretches alone");
  }
  progress("weighing the sets", 0);
  const std::vector<Eigen::Index> columns = cause_columns(study.library);
  const gap::Question question = question_of(study, columns);
  const Eigen::VectorXd& nominal = study.bank.prior.mean;
  const LayoutRehearser rehearser(study.request.layout, study.library, *source, study.recordings.recording,
                                  nominal, [&](const gap::Hypothesis& set) {
                                    Eigen::VectorXd departures = nominal;
                                    departures(columns) += set.mean;
                                    return departures;
                                  });
  return gap::plan_next_mission(question, rehearser, limits, progress);
}

}  // namespace navcal::diagnosis
