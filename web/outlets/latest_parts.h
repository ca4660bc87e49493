// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

namespace navcal::web {

/// The newest lines of a report that navcald cuts into several (`part` and `parts`), in their order.
class LatestParts {
 public:
  void take(nlohmann::json part) {
    const auto whole = [&part](const char* key) {
      const auto found = part.find(key);
      return found != part.end() && found->is_number_unsigned() ? found->get<std::size_t>() : std::size_t{1};
    };
    const std::size_t number = whole("part"), count = whole("parts");
    if (number < 1 || number > count || count > kMaxParts) return;
    parts_.resize(count);
    parts_[number - 1] = std::move(part);
  }
  void forget() { parts_.clear(); }
  /// Those that have not come yet are null.
  [[nodiscard]] const std::vector<nlohmann::json>& parts() const { return parts_; }

 private:
  static constexpr std::size_t kMaxParts = 64;
  std::vector<nlohmann::json> parts_;
};

}  // namespace navcal::web
