// SPDX-License-Identifier: Apache-2.0
#include "config/complaints.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <numeric>
#include <utility>

namespace navcal::config {
namespace {

std::string words_for(const Problem& problem, std::string_view file) {
  std::string out = problem.line == 0 ? "--set" : fmt::format("{}:{}", file, problem.line);
  if (!problem.key.empty()) out += ": " + problem.key;
  return out + ": " + problem.message;
}

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

Error::Error(std::vector<std::string> problems)
    : std::runtime_error(fmt::format("{}", fmt::join(problems, "\n"))), problems_(std::move(problems)) {}

void refuse(std::vector<Problem> problems, std::string_view file) {
  if (problems.empty()) return;
  // Line 0 is the command line: with one taken off it is the greatest number there is.
  std::stable_sort(problems.begin(), problems.end(),
                   [](const Problem& a, const Problem& b) { return a.line - 1 < b.line - 1; });
  std::vector<std::string> lines;
  for (const Problem& problem : problems) lines.push_back(words_for(problem, file));
  throw Error(std::move(lines));
}

std::string content_of(const std::filesystem::path& file) {
  const auto refused = [&file](int reason) {
    return Error({fmt::format("{}: cannot be read: {}", file.native(), std::strerror(reason))});
  };
  errno = 0;
  std::ifstream in(file, std::ios::binary);
  if (!in) throw refused(errno);
  if (std::filesystem::is_directory(file)) throw refused(EISDIR);
  std::string content{std::istreambuf_iterator<char>(in), {}};
  if (in.bad()) throw refused(errno != 0 ? errno : EIO);
  return content;
}

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
