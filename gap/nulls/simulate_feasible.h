// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/parallel.h"
#include "gap/nulls/null_bank.h"
#include "sim/vehicle/body.h"

namespace navcal::gap {

/// First seed of each kind of simulated mission, so that no two kinds share one.
enum class Seeds : std::uint64_t { bank = 0, backlash_null_bank = 500'000, null_gains = 700'000 };

/// Results of job(number, seed) for as many simulated vehicles as `options` says, in order of their numbers. A
/// vehicle that cannot swim the recorded way (sim::UnstableVehicle) is left out, so there may be fewer results.
/// `progress` gets the share that is done.
template <class Job>
auto simulate_feasible(
    const BankOptions& options, Seeds seeds, Job job,
    const std::function<void(double)>& progress = [](double) {}) {
  using Answer = std::invoke_result_t<Job, std::size_t, std::uint64_t>;
  std::vector<std::optional<Answer>> answers(static_cast<std::size_t>(options.missions));
  std::size_t done = 0;
  std::mutex done_mutex;
  base::in_parallel(options.threads, answers.size(), [&](std::size_t i) {
    try {
      answers[i] = job(i, options.seed * 1'000'003 + static_cast<std::uint64_t>(seeds) + i);
    } catch (const sim::UnstableVehicle&) {
    }
    const std::lock_guard lock(done_mutex);
    progress(static_cast<double>(++done) / static_cast<double>(answers.size()));
  });
  std::vector<Answer> able;
  for (auto& answer : answers) {
    if (answer) able.push_back(std::move(*answer));
  }
  return able;
}

}  // namespace navcal::gap
