// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/cause_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "diagnosis/limits.h"

namespace navcal::diagnosis {
namespace {

/// Whether a cause is none of a set, and none that stands for one of it.
bool is_new(std::size_t cause, const CauseSet& set, const CauseLibrary& library) {
  return std::none_of(set.begin(), set.end(), [&](std::size_t member) {
    return member == cause || are_one(library.causes[member], library.causes[cause]);
  });
}

CauseSet with(CauseSet set, std::size_t cause) {
  set.insert(std::upper_bound(set.begin(), set.end(), cause), cause);
  return set;
}

/// Scores of sets, and which of them were fitted at their own estimate.
class Scores {
 public:
  /// A set that was fitted keeps the score of its own fit.
  void set(const CauseSet& causes, double log_odds, bool is_own = false) {
    if (is_own) own_.insert(causes);
    if (is_own || !own_.contains(causes)) scores_[causes] = log_odds;
  }
  [[nodiscard]] bool is_fitted(const CauseSet& causes) const { return own_.contains(causes); }
  [[nodiscard]] std::vector<ScoredSet> ranked() const {
    std::vector<ScoredSet> all;
    for (const auto& [causes, log_odds] : scores_) all.push_back({causes, log_odds, 0});
    std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.log_odds > b.log_odds; });
    double sum = 0;
    for (const ScoredSet& one : all) sum += std::exp(one.log_odds - all.front().log_odds);
    for (ScoredSet& one : all) one.probability = std::exp(one.log_odds - all.front().log_odds) / sum;
    return all;
  }

 private:
  std::map<CauseSet, double> scores_;
  std::set<CauseSet> own_;
};

/// Sets of causes of a recording: their scores, and fits of those that lead.
class Search {
 public:
  Search(RecordingModel& recording, const JointPrior& prior, const CauseLibrary& library);

  /// The leading single causes, then whatever leads or would be a rival without a fit of its own.
  void fit_leaders(const Progress& progress);
  /// A dead, a reversed and a weak actuator lie far apart in one direction, so each is fitted where one leads.
  void fit_in_place();
  /// Fits the leaders once more, each from where it was, with the gains of the best one's vehicle. The filter of
  /// the nominal vehicle may have been led so far astray that its gains serve no other. False: nothing was done.
  bool hold_at_best();
  [[nodiscard]] CauseSearchResult result() &&;

 private:
  [[nodiscard]] bool is_fitted(const CauseSet& set) const { return scores_.is_fitted(set); }
  /// An actuator that is dead or reversed is as far as that from the nominal vehicle, and each of them has another
  /// filter. Holds the gains of the one that follows best, where it follows far better. False: none does.
  bool hold_at_switch();
  /// Settles the departures without a cause, from some on; else those before stay.
  void fit_none(Eigen::VectorXd from);
  /// Begin of the search for the departures with these causes.
  [[nodiscard]] Departures begin_of(const CauseSet& set) const;
  [[nodiscard]] double likelihood_at(const Eigen::VectorXd& at) const;
  void fit_again(const CauseSet& set);

  RecordingModel& recording_;
  const JointPrior& prior_;
  const CauseLibrary& library_;
  /// At the prior's mean, and settled without a cause; nullopt: with these gains it could not have moved so.
  std::optional<RecordingFit> first_, nominal_;
  /// Evidence of no cause, with what it promises: nobody is blamed for that. Of the prior's mean where there is
  /// none.
  double none_ = 0;
  Scores scores_;
  std::map<CauseSet, RecordingFit> fits_;  ///< with the present gains
  std::map<CauseSet, Departures> begins_;  ///< from where sets are fitted, where that is known
};

Search::Search(RecordingModel& recording, const JointPrior& prior, const CauseLibrary& library)
    : recording_(recording), prior_(prior), library_(library), first_(recording.fit(prior.mean)) {
  if (first_) none_ = first_->linear.about(prior.mean).value;
  const bool is_switched = first_ && first_->is_astray() && hold_at_switch();
  // Causes are looked for where the nominal vehicle is: its tolerances, fitted to a gap, lead astray.
  fit_none(prior.mean);
  if (!nominal_ && !is_switched) throw cannot_follow(recording.recording());
  if (!first_) first_ = nominal_;
  const SetEvidence about_first(prior.of_changes(first_->guide()), library);
  for (std::size_t i = 0; i < library.causes.size(); ++i) {
    scores_.set({i}, none_ + about_first.gain({i}));
    for (std::size_t j = i + 1; j < library.causes.size(); ++j) {
      if (is_new(j, {i}, library)) scores_.set({i, j}, none_ + about_first.gain({i, j}));
    }
  }
  if (is_switched) fit_again(begins_.begin()->first);
}

bool Search::hold_at_switch() {
  double least = first_->mean_square / kFarBetter;
  for (std::size_t i = 0; i < library_.causes.size(); ++i) {
    const CauseParameter& parameter = library_.causes[i].parameters.front();
    if (!parameter.is_switch()) continue;
    Eigen::VectorXd change = Eigen::VectorXd::Zero(library_.columns());
    change[parameter.column] = parameter.typical * parameter.per_unit;
    const Eigen::VectorXd at = prior_.mean + prior_.in_each(change);
    const auto power = recording_.power(at);
    if (!power || power->mean_square >= least) continue;
    least = power->mean_square;
    begins_ = {{CauseSet{i}, {at, change}}};
  }
  return !begins_.empty() && recording_.hold(begins_.begin()->second.at);
}

void Search::fit_none(Eigen::VectorXd from) {
  const Eigen::VectorXd no_change = Eigen::VectorXd::Zero(library_.columns());
  auto there =
      settled(recording_, prior_, {std::move(from), no_change}, [&](const auto&...) { return no_change; });
  if (there) {
    nominal_ = std::move(there);
    none_ = prior_.of_changes(nominal_->linear).evidence();
  }
  scores_.set({}, none_, true);
}

double Search::likelihood_at(const Eigen::VectorXd& at) const {
  return recording_.log_likelihood(recording_.within(at)).value_or(-std::numeric_limits<double>::infinity());
}

Departures Search::begin_of(const CauseSet& set) const {
  if (const auto begin = begins_.find(set); begin != begins_.end()) return begin->second;
  // From the fit of the set without one of its members, where there is one.
  const RecordingFit* here = &*first_;
  for (std::size_t left = 0; left < set.size(); ++left) {
    CauseSet smaller = set;
    smaller.erase(smaller.begin() + static_cast<std::ptrdiff_t>(left));
    if (const auto found = fits_.find(smaller); found != fits_.end()) here = &found->second;
  }
  const Likelihood guide = here->guide();
  Eigen::VectorXd change =
      SetEvidence(prior_.of_changes(guide), library_).posterior(set).among(library_.columns());
  const Eigen::VectorXd begin = prior_.in_each(change);
  // Far from the nominal vehicle its slopes make tolerances of the gap, at times such that no vehicle survives.
  Eigen::VectorXd with_tolerances = prior_.posterior_mean(guide.about(begin)) + begin;
  Eigen::VectorXd alone = prior_.mean + begin;
  const bool is_alone = likelihood_at(with_tolerances) < likelihood_at(alone);
  return {std::move(is_alone ? alone : with_tolerances), std::move(change)};
}

void Search::fit_again(const CauseSet& set) {
  auto there = settled(
      recording_, prior_, begin_of(set),
      [&](const Likelihood& changes, const Anchor& anchor) {
        return SetEvidence(changes, library_).posterior(set, anchor).among(library_.columns());
      },
      [&](const Eigen::VectorXd& change) { return log_prior_of(change, set, library_); });
  if (!there) {
    // The vehicle could not have moved so with these effects.
    scores_.set(set, none_ - kImpossible_nats, true);
    return;
  }
  const double score = SetEvidence(prior_.of_changes(there->linear), library_)(set) - there->promised_nats;
  scores_.set(set, score, true);
  const SetEvidence guided(prior_.of_changes(there->guide()), library_);
  const double guided_gain = guided.gain(set);
  for (std::size_t i = 0; i < library_.causes.size() && set.size() < kMostEffects; ++i) {
    if (is_new(i, set, library_)) scores_.set(with(set, i), score + guided.gain(with(set, i)) - guided_gain);
  }
  fits_.insert_or_assign(set, std::move(*there));
}

void Search::fit_leaders(const Progress& progress) {
  for (std::size_t done = 0; done < kRefitted + kReconsidered; ++done) {
    progress(static_cast<double>(done) / (kRefitted + kReconsidered));
    const auto ranked = scores_.ranked();
    const bool is_single = done < kRefitted;
    const auto next = std::find_if(ranked.begin(), ranked.end(), [&](const ScoredSet& one) {
      return !is_fitted(one.causes) && (!is_single || one.causes.size() == 1);
    });
    const double least = is_single ? none_ : ranked.front().log_odds - kClass_nats;
    if (next == ranked.end() || (done > 0 && next->log_odds < least)) {
      if (!is_single) break;
      done = kRefitted - 1;
      continue;
    }
    fit_again(CauseSet(next->causes));
  }
}

void Search::fit_in_place() {
  const CauseSet leader = scores_.ranked().front().causes;
  for (const std::size_t member : leader) {
    for (std::size_t other = 0; other < library_.causes.size(); ++other) {
      CauseSet in_place = leader;
      std::erase(in_place, member);
      in_place = with(std::move(in_place), other);
      if (are_one(library_.causes[member], library_.causes[other]) && !is_fitted(in_place)) fit_again(in_place);
    }
  }
}

bool Search::hold_at_best() {
  const auto ranked = scores_.ranked();
  const auto best = fits_.find(ranked.front().causes);
  if (!first_->is_astray() || best == fits_.end() || !recording_.hold(best->second.at)) return false;
  begins_.clear();
  for (const auto& [set, fit] : std::exchange(fits_, {})) begins_.emplace(set, Departures{fit.at, fit.change});
  scores_ = {};
  fit_none(nominal_ ? Eigen::VectorXd(nominal_->at) : prior_.mean);
  for (const ScoredSet& one : ranked) {
    if (begins_.contains(one.causes)) fit_again(one.causes);
  }
  return true;
}

CauseSearchResult Search::result() && {
  CauseSearchResult result;
  const Eigen::Index count = prior_.mean.size();
  result.none = {Eigen::MatrixXd::Zero(count, count), Eigen::VectorXd::Zero(count)};
  if (nominal_) result.none = nominal_->linear;
  result.sets = scores_.ranked();
  // A set without a fit of its own does not lead.
  const auto erased = std::erase_if(result.sets, [&, leads = true](const ScoredSet& one) mutable {
    leads = leads && !is_fitted(one.causes);
    return leads;
  });
  const double rest = std::accumulate(result.sets.begin(), result.sets.end(), 0.0,
                                      [](double sum, const ScoredSet& one) { return sum + one.probability; });
  for (ScoredSet& one : result.sets)
    if (erased > 0 && rest > 0) one.probability /= rest;
  const CauseSet& best = result.sets.front().causes;
  if (best.empty() && !nominal_) throw cannot_follow(recording_.recording());
  result.best = best.empty() ? std::move(*nominal_) : std::move(fits_.at(best));
  result.changes = prior_.of_changes(result.best.linear);
  return result;
}

}  // namespace

CauseSearchResult search_causes(RecordingModel& recording, const JointPrior& prior, const CauseLibrary& library,
                                const Progress& progress) {
  Search search(recording, prior, library);
  search.fit_leaders(progress);
  search.fit_in_place();
  if (search.hold_at_best()) {
    search.fit_leaders(progress);
    search.fit_in_place();
  }
  return std::move(search).result();
}

}  // namespace navcal::diagnosis
