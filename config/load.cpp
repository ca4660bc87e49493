#include "config/load.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>
#include <utility>

#include "config/document.h"
#include "config/reader.h"

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

Settings parse(std::string_view toml, std::string_view name, const Overrides& overrides) {
  std::vector<Problem> problems;
  auto entries = read_document(toml, problems);
  const bool readable = problems.empty();
  for (const std::string& text : overrides) {
    if (auto entry = read_override(text, problems)) entries.push_back(std::move(*entry));
  }
  Reader reader;
  if (readable) {
    reader.take(entries);
    reader.check_ports();
  }
  auto& found = reader.problems();
  problems.insert(problems.end(), found.begin(), found.end());
  if (problems.empty()) return reader.settings();

  // In the order of the file, the command line last.
  std::stable_sort(problems.begin(), problems.end(),
                   [](const Problem& a, const Problem& b) { return a.line - 1 < b.line - 1; });
  std::vector<std::string> lines;
  for (const Problem& problem : problems) lines.push_back(words_for(problem, name));
  throw Error(std::move(lines));
}

Settings load(const std::filesystem::path& file, const Overrides& overrides) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream content;
  if (!in || !(content << in.rdbuf())) {
    throw Error({fmt::format("{}: cannot be read: {}", file.native(), std::strerror(errno))});
  }
  return parse(content.str(), file.native(), overrides);
}

}  // namespace navcal::config
