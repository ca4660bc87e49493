// SPDX-License-Identifier: Apache-2.0
#include "bench/calibration/cost.h"

#include <fmt/format.h>

#include <chrono>
#include <cstdio>

#include "bench/calibration/turn_tables.h"

namespace navcal::bench {
namespace {

/// Mean of the last thousand updates before `samples`, so that growth with time would show.
double nanoseconds_per_update(const CostItem& item, std::size_t samples) {
  constexpr std::size_t kTimed = 1000;
  const auto update = item.make();
  std::size_t i = 0;
  for (; i + kTimed < samples; ++i) update(i);
  const auto begin = std::chrono::steady_clock::now();
  for (; i < samples; ++i) update(i);
  const std::chrono::duration<double, std::nano> taken = std::chrono::steady_clock::now() - begin;
  return taken.count() / kTimed;
}

}  // namespace

void print_cost(const TableOptions&) {
  std::puts(
      "Nanoseconds for one update, means of the last thousand of so many.\n\n"
      "| estimator | 10^3 | 10^5 | 10^6 | 10^7 |\n|-|-|-|-|-|");
  for (const auto& items : {turn_costs(), suite_costs()}) {
    for (const CostItem& item : items) {
      std::string row = fmt::format("| {} |", item.name);
      for (const std::size_t samples : {1'000UL, 100'000UL, 1'000'000UL, 10'000'000UL}) {
        row += samples <= item.longest ? fmt::format(" {:.0f} |", nanoseconds_per_update(item, samples)) : " |";
      }
      std::puts(row.c_str());
    }
  }
}

}  // namespace navcal::bench
