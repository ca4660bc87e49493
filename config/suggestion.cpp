// SPDX-License-Identifier: Apache-2.0
#include "config/suggestion.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>
#include <utility>

namespace navcal::config {
namespace {

/// Insertions, deletions, replacements and exchanges of neighbours that make one word of the other.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before;  // the rows of the two letters before
  std::vector<std::size_t> above(b.size() + 1);
  std::iota(above.begin(), above.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::vector<std::size_t> row{i + 1};
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = above[j] + (a[i] == b[j] ? 0 : 1);
      row.push_back(std::min({row[j] + 1, above[j + 1] + 1, replaced}));
      const bool exchanged = i > 0 && j > 0 && a[i] == b[j - 1] && a[i - 1] == b[j];
      if (exchanged) row[j + 1] = std::min(row[j + 1], before[j - 1] + 1);
    }
    before = std::exchange(above, std::move(row));
  }
  return above.back();
}

}  // namespace

std::string suggestion(std::string_view given, const std::vector<std::string>& known) {
  constexpr std::size_t kLongestWord = 64;
  if (given.size() > kLongestWord) return {};
  std::size_t nearest = 1 + std::max<std::size_t>(given.size() / 3, 1);
  std::string meant;
  for (const std::string& word : known) {
    // A forgotten unit (sync_interval for sync_interval_s) is the likeliest slip of all.
    const std::size_t distance = word.starts_with(std::string(given) + '_') ? 1 : edit_distance(given, word);
    if (distance < nearest) {
      nearest = distance;
      meant = word;
    }
  }
  return meant.empty() ? meant : "; did you mean " + meant + "?";
}

std::string suggestion_or_all(std::string_view given, const std::vector<std::string>& known) {
  const std::string guess = suggestion(given, known);
  return guess.empty() ? fmt::format("; known: {}", fmt::join(known, ", ")) : guess;
}

}  // namespace navcal::config
