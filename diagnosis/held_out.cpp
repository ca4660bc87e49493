// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/held_out.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <limits>
#include <numeric>
#include <optional>
#include <random>

#include "diagnosis/limits.h"

namespace navcal::diagnosis {

namespace {

/// Log probability of a recording with a set as it was estimated elsewhere, but for a constant.
double predicted(const Likelihood& changes, const SetEvidence& estimated, const CauseSet& set) {
  if (set.empty()) return changes.value;
  const auto posterior = estimated.posterior(set);
  return changes.of(posterior.columns).about(posterior.mean).blurred(posterior.covariance.llt().matrixL()).value;
}

}  // namespace

ExplainedRecording held_out(RecordingModel& recording, const JointPrior& prior, const CauseLibrary& library,
                            const CauseSearchResult& found) {
  const CauseSet& best = found.sets.front().causes;
  const SetEvidence estimated(found.changes, library);
  const Eigen::VectorXd change = estimated.posterior(best).among(library.columns());
  const auto changed_by = [&](const Eigen::VectorXd& by) {
    return settled(recording, prior, {prior.mean + by, by}, [&](const auto&...) { return by; });
  };
  auto none = changed_by(Eigen::VectorXd::Zero(library.columns()));
  ExplainedRecording explained{-std::numeric_limits<double>::infinity(), {}, {}, {}};
  if (!none) throw cannot_follow(recording.recording());
  explained.before = explained.after =
      recording.power(recording.own_departures(prior, none->linear)).value_or(RecordingPower{});
  // As the search does behind a gap that leads astray.
  const auto first = recording.fit(prior.mean);
  if (first && first->is_astray() && recording.hold(prior.mean + change))
    none = changed_by(Eigen::VectorXd::Zero(library.columns()));
  const auto with = changed_by(change);
  // A vehicle with these effects could not have moved as this one did.
  if (!with) return explained;
  const Likelihood changes = prior.of_changes(with->linear);
  const double of_all = predicted(changes, estimated, best);
  explained.gain_nats = none ? of_all - prior.of_changes(none->linear).value : kImpossible_nats;
  for (std::size_t left = 0; left < best.size(); ++left) {
    CauseSet others = best;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(left));
    explained.member_nats.push_back(others.empty() ? explained.gain_nats
                                                   : of_all - predicted(changes, estimated, others));
  }
  const auto after = recording.power(recording.own_departures(prior, with->linear.about(change)) + change);
  if (after) explained.after = *after;
  return explained;
}

gap::Closure closure_of(std::span<const ExplainedRecording> recordings, double floor, std::uint64_t seed) {
  std::vector<double> before, after, readings;
  const auto append = [](std::vector<double>& all, const std::vector<double>& more) {
    all.insert(all.end(), more.begin(), more.end());
  };
  for (const ExplainedRecording& one : recordings) {
    append(before, one.before.of_block);
    append(after, one.after.of_block);
    append(readings, one.before.readings);
  }
  const auto closed = [&](const auto& index) -> std::optional<double> {
    double b = 0, a = 0, n = 0;
    for (std::size_t i = 0; i < before.size(); ++i) {
      b += before[index(i)];
      a += after[index(i)];
      n += readings[index(i)];
    }
    if (b / n <= 1.05 * floor) return std::nullopt;
    return 1 - (a / n - floor) / (b / n - floor);
  };
  const double n = std::accumulate(readings.begin(), readings.end(), 0.0);
  gap::Closure pooled;
  pooled.before = std::accumulate(before.begin(), before.end(), 0.0) / n;
  pooled.after = std::accumulate(after.begin(), after.end(), 0.0) / n;
  pooled.floor = floor;
  pooled.closed = closed([](std::size_t i) { return i; });
  if (!pooled.closed) return pooled;
  std::mt19937_64 random(seed);
  std::vector<double> closures;
  for (int k = 0; k < 400; ++k) {
    std::vector<std::size_t> drawn(before.size());
    for (std::size_t& index : drawn) index = random() % before.size();
    if (const auto closure = closed([&](std::size_t i) { return drawn[i]; })) closures.push_back(*closure);
  }
  if (closures.size() < 40) return pooled;
  std::sort(closures.begin(), closures.end());
  pooled.closed_ci = {closures[closures.size() / 40], closures[closures.size() - 1 - closures.size() / 40]};
  return pooled;
}

}  // namespace navcal::diagnosis
