// SPDX-License-Identifier: Apache-2.0
#include "config/complaints.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <utility>

namespace navcal::config {
namespace {

std::string words_for(const Problem& problem, std::string_view file) {
  std::string out = problem.line == 0 ? "--set" : fmt::format("{}:{}", file, problem.line);
  if (!problem.key.empty()) out += ": " + problem.key;
  return out + ": " + problem.message;
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

}  // namespace navcal::config
