// SPDX-License-Identifier: Apache-2.0
#include "config/described/description_file.h"

#include <fmt/format.h>

#include <algorithm>

#include "config/complaints.h"
#include "config/described/parts.h"

namespace navcal::config {
namespace {

using protocols::described::Description;
using protocols::described::FrameKind;

constexpr std::size_t kMaxKinds = 32;
constexpr std::size_t kMaxStartUp = 32;

/// "hex A5 01" is sent as bytes, anything else as it stands.
std::vector<std::string> read_start_up(TableReader& table) {
  constexpr std::string_view kHex = "hex ";
  auto lines = table.texts("start_up");
  if (lines.size() > kMaxStartUp) {
    table.complain("start_up", fmt::format("{} texts; {} is the most", lines.size(), kMaxStartUp));
    lines.clear();
  }
  for (std::string& line : lines) {
    if (line.empty() || line.size() > protocols::described::kMaxFrameLength) {
      table.complain("start_up",
                     fmt::format("each text has 1 to {} characters", protocols::described::kMaxFrameLength));
    }
    if (!line.starts_with(kHex)) continue;
    if (auto bytes = bytes_of_hex(std::string_view(line).substr(kHex.size()))) {
      line = std::move(*bytes);
    } else {
      table.complain("start_up", to_toml_text(line) + " has no bytes in hexadecimal behind \"hex \"");
    }
  }
  return lines;
}

unsigned line_of_id(const Node& frame) {
  const auto id = std::ranges::find_if(frame.children, [](const Node& child) { return child.key == "id"; });
  return id != frame.children.end() ? id->line : frame.line;
}

/// Two kinds of frames that nothing tells apart, so that the second is never found.
void check_kinds(const std::vector<FrameKind>& kinds, const std::vector<const Node*>& nodes,
                 std::vector<Problem>& problems) {
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const FrameKind &mine = kinds[i], &other = kinds[j];
      if (mine.id == other.id && !mine.id.view().empty())
        problems.push_back({line_of_id(*nodes[i]), nodes[i]->name + ".id",
                            fmt::format("\"{}\" is already that of {} (line {})", mine.id.view(), nodes[j]->name,
                                        nodes[j]->line)});
      const bool alike = mine.start == other.start && mine.constants == other.constants &&
                         mine.length == other.length && mine.checksum == other.checksum &&
                         mine.count == other.count;
      if (alike)
        problems.push_back({nodes[i]->line, nodes[i]->name,
                            fmt::format("nothing tells its frames from those of {} (line {}), which comes first",
                                        nodes[j]->name, nodes[j]->line)});
    }
  }
}

void read_device(TableReader& table, Description& description) {
  if (auto name = table.text("name")) description.name = std::move(*name);
  constexpr std::int64_t kSlowest = 50, kFastest = 4'000'000;
  if (const auto baud = table.whole("baud", kSlowest, kFastest)) description.baud = static_cast<int>(*baud);
  description.rate_Hz = table.number("rate_Hz", 0, 1000, "Hz");
  const auto seconds = [](std::optional<double> ms) { return ms ? std::optional(*ms * 1 / 1000) : std::nullopt; };
  description.latency_s = seconds(table.number("latency_ms", 0, 10000, "ms"));
  description.latency_std_s = seconds(table.number("latency_std_ms", 0, 10000, "ms"));
  description.start_up = read_start_up(table);
}

}  // namespace

Description read_description(std::string_view toml, std::vector<Problem>& problems) {
  Description description;
  if (toml.size() > kMaxDescription) {
    problems.push_back({1, "", fmt::format("the description has more than {} bytes", kMaxDescription)});
    return description;
  }
  const std::size_t before = problems.size();
  const Node root = read_tree(toml, problems);
  if (problems.size() > before) return description;
  TableReader table(root, problems);
  table.require("form", "known: binary or text");
  description.is_text = table.choice("form", {"binary", "text"}) == "text";
  read_device(table, description);
  described::Defaults defaults;
  defaults.is_text = description.is_text;
  described::take_defaults(table, defaults);
  const auto frames = table.tables("frame");
  if (frames.empty()) table.require("frame", "a description has a [[frame]] or more");
  if (frames.size() > kMaxKinds)
    table.complain("frame", fmt::format("{} kinds of frames; {} is the most", frames.size(), kMaxKinds));
  table.finish();
  if (!table.has("form")) return description;  // the keys of frames depend on it
  for (std::size_t i = 0; i < std::min(frames.size(), kMaxKinds); ++i)
    description.kinds.push_back(described::read_frame(*frames[i], defaults, problems));
  check_kinds(description.kinds, frames, problems);
  return description;
}

Description parse_description(std::string_view toml, std::string_view name) {
  std::vector<Problem> problems;
  Description description = read_description(toml, problems);
  refuse(std::move(problems), name);
  return description;
}

Description load_description(const std::filesystem::path& file) {
  return parse_description(content_of(file), file.native());
}

}  // namespace navcal::config
