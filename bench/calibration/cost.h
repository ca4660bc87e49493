// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <string_view>
#include <vector>

namespace navcal::bench {

/// Something that takes samples forever; made by a function, so that each measurement begins with a new one.
struct CostItem {
  std::string_view name;
  std::function<std::function<void(std::size_t sample)>()> make;
  std::size_t longest = 10'000'000;  ///< samples; less where more would take minutes
};

/// Costs of one package each. A new estimator is one more entry in one of them, a new package one more line in
/// cost.cpp.
[[nodiscard]] std::vector<CostItem> turn_costs();
[[nodiscard]] std::vector<CostItem> suite_costs();

}  // namespace navcal::bench
