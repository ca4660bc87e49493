// SPDX-License-Identifier: Apache-2.0
#include "config/load.h"

#include <utility>

#include "config/complaints.h"
#include "config/document.h"
#include "config/reader.h"

namespace navcal::config {

namespace {

Settings parse_in(std::optional<std::filesystem::path> folder, std::string_view toml, std::string_view name,
                  const Overrides& overrides) {
  std::vector<Problem> problems;
  auto entries = read_document(toml, problems);
  const bool readable = problems.empty();
  for (const std::string& text : overrides) {
    if (auto entry = read_override(text, problems)) entries.push_back(std::move(*entry));
  }
  Reader reader(std::move(folder));
  if (readable) {
    reader.take(entries);
    reader.check_ports();
    reader.check_roles();
    reader.check_instruments(entries);
    reader.check_command();
    reader.check_log();
    reader.check_power();
    reader.check_remote();
  }
  auto& found = reader.problems();
  problems.insert(problems.end(), found.begin(), found.end());
  refuse(std::move(problems), name);
  return reader.settings();
}

}  // namespace

Settings parse(std::string_view toml, std::string_view name, const Overrides& overrides) {
  return parse_in(std::nullopt, toml, name, overrides);
}

Settings load(const std::filesystem::path& file, const Overrides& overrides) {
  return parse_in(file.parent_path(), content_of(file), file.native(), overrides);
}

}  // namespace navcal::config
