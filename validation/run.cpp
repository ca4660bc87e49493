// SPDX-License-Identifier: Apache-2.0
#include "validation/run.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <set>
#include <thread>
#include <tuple>
#include <utility>

#include "base/interruptible.h"
#include "validation/case_runner.h"

namespace navcal::validation {
namespace {

class CaseQueue {
 public:
  CaseQueue(const std::vector<TrialCase>& cases, const std::vector<Commitment>& seals,
            const CaseRunOptions& asking, const std::function<void(const TrialResult&)>& answered)
      : cases_(cases), seals_(seals), asking_(asking), answered_(answered) {}

  void ask_one(std::size_t i, bool first_of_its_kind) {
    try {
      auto result = ask(cases_[i], seals_[i], asking_);
      const std::lock_guard lock(mutex_);
      if (!result) return;
      result->first_of_its_kind = first_of_its_kind;
      answered_(*result);
      run_.results.push_back(std::move(*result));
    } catch (const std::exception& error) {
      const std::lock_guard lock(mutex_);
      run_.ended_early = error.what();
    }
  }

  void ask_in_parallel(const std::vector<std::size_t>& those) {
    std::atomic<std::size_t> next{0};
    std::vector<std::jthread> workers;
    for (unsigned job = 0; job < asking_.jobs; ++job) {
      workers.emplace_back([&] {
        for (std::size_t i = next++; i < those.size() && !ends_early(); i = next++) ask_one(those[i], false);
      });
    }
  }

  [[nodiscard]] bool ends_early() {
    const std::lock_guard lock(mutex_);
    if (base::Interruptible::interrupted()) run_.ended_early = "interrupted";
    return !run_.ended_early.empty();
  }

  [[nodiscard]] TrialRun finish() {
    (void)ends_early();
    std::sort(run_.results.begin(), run_.results.end(),
              [](const auto& a, const auto& b) { return a.drawn.number < b.drawn.number; });
    return std::move(run_);
  }

 private:
  const std::vector<TrialCase>& cases_;
  const std::vector<Commitment>& seals_;
  const CaseRunOptions& asking_;
  const std::function<void(const TrialResult&)>& answered_;
  std::mutex mutex_;
  TrialRun run_;
};

}  // namespace

TrialRun ask_all(const std::vector<TrialCase>& cases, const std::vector<Commitment>& seals,
                 const CaseRunOptions& asking, const std::function<void(const TrialResult&)>& answered) {
  CaseQueue all(cases, seals, asking, answered);
  std::set<std::tuple<MissionKind, int, int>> begun;
  std::vector<std::size_t> rest;
  for (std::size_t i = 0; i < cases.size() && !all.ends_early(); ++i) {
    if (begun.emplace(facts_of(cases[i].arm).missions, cases[i].minutes, cases[i].place_number).second)
      all.ask_one(i, true);
    else
      rest.push_back(i);
  }
  all.ask_in_parallel(rest);
  return all.finish();
}

}  // namespace navcal::validation
