// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <map>

#include "analysis/device_guess_parts.h"
#include "protocols/checked_line.h"
#include "protocols/described/text.h"

namespace navcal::analysis {
namespace {

using protocols::Bytes;
using NumberType = protocols::described::Type;

constexpr std::size_t kLeastLines = 3;
constexpr std::size_t kMostKinds = 16;

/// Columns of lines that begin alike.
struct Column {
  std::string key;  ///< of `T=12.3`
  std::size_t numbers = 0;
  double low = 0, high = 0;

  void take(double value) {
    low = numbers == 0 ? value : std::min(low, value);
    high = numbers == 0 ? value : std::max(high, value);
    ++numbers;
  }
};

struct LineKind {
  std::string start;
  std::size_t lines = 0, checked = 0;
  std::map<std::size_t, std::size_t> counts;  ///< lines by their number of fields
  std::vector<Column> columns;
};

std::vector<std::string_view> lines_of(Bytes capture) {
  std::string_view text(reinterpret_cast<const char*>(capture.data()), capture.size());
  std::vector<std::string_view> lines;
  // The first line may lack its beginning, and what stands behind the last end is not whole.
  for (std::size_t end = text.find('\n'); end != std::string_view::npos; end = text.find('\n')) {
    std::string_view line = text.substr(0, end);
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (!line.empty()) lines.push_back(line);
    text.remove_prefix(end + 1);
  }
  return lines;
}

/// The character that stands in most lines, of those that separate.
char separator_of(const std::vector<std::string_view>& lines) {
  constexpr std::array kSeparators{',', ';', '\t', ' '};
  char best = ',';
  std::size_t most = 0;
  for (const char separator : kSeparators) {
    const auto with = static_cast<std::size_t>(std::ranges::count_if(
        lines, [&](std::string_view line) { return line.find(separator) != std::string_view::npos; }));
    if (with > most) best = separator;
    most = std::max(most, with);
  }
  return best == '\t' ? ' ' : best;
}

/// `$...*hh` whose checksum holds.
bool is_checked(std::string_view line) {
  const std::string whole = std::string(line) + "\n";
  const auto* const first = reinterpret_cast<const std::uint8_t*>(whole.data());
  return line.starts_with('$') &&
         protocols::scan_checked_line(first, first + whole.size(), protocols::described::kMaxFrameLength, {})
                 .kind == protocols::Scan::Kind::frame;
}

bool is_number(std::string_view text) {
  return protocols::described::number_of(text, NumberType::decimal).has_value();
}

/// What lines of the same kind begin with: the first word and the separator, or the first key and its sign;
/// nothing when the line begins with a number.
std::string start_of(std::string_view line, char separator) {
  const std::size_t end = line.find(separator);
  const std::string_view word = line.substr(0, end);
  if (is_number(word)) return {};
  if (const std::size_t sign = word.find('='); sign != std::string_view::npos)
    return std::string(word.substr(0, sign + 1));
  return end == std::string_view::npos ? std::string() : std::string(line.substr(0, end + 1));
}

void take_line(std::string_view line, char separator, LineKind& kind) {
  ++kind.lines;
  if (is_checked(line)) {
    ++kind.checked;
    line = line.substr(0, line.rfind('*'));
  }
  line.remove_prefix(kind.start.size());
  protocols::described::TextFields fields;
  protocols::described::split(separator, {reinterpret_cast<const std::uint8_t*>(line.data()), line.size()},
                              fields);
  ++kind.counts[fields.count];
  kind.columns.resize(std::max(kind.columns.size(), fields.count));
  for (std::size_t i = 0; i < fields.count; ++i) {
    std::string_view field = protocols::described::without_blanks(fields[i + 1]);
    Column& column = kind.columns[i];
    if (const std::size_t sign = field.find('='); sign != std::string_view::npos) {
      column.key = std::string(field.substr(0, sign));
      field.remove_prefix(sign + 1);
    }
    if (const auto number = protocols::described::number_of(field, NumberType::decimal)) column.take(*number);
  }
}

std::string id_of(const std::string& start, std::size_t number) {
  std::string id;
  for (const char c : start) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0 && id.size() < 16) id += c;
  }
  return id.empty() ? fmt::format("LINE{}", number) : id;
}

/// As TOML writes a text; the characters of a line that count are printable.
std::string in_quotes(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + '"';
}

bool is_printable(const std::string& text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return c >= ' ' && c < 0x7F; });
}

std::string columns_of(const LineKind& kind) {
  std::string out;
  for (std::size_t i = 0; i < kind.columns.size(); ++i) {
    const Column& column = kind.columns[i];
    if (column.numbers == 0) continue;
    const bool has_key = !column.key.empty() && is_printable(column.key);
    const std::string place =
        has_key ? fmt::format("key = {}", in_quotes(column.key)) : fmt::format("number = {}", i + 1);
    const std::string seen = column.low == column.high ? fmt::format("always {:g}", column.low)
                                                       : fmt::format("{:g} to {:g}", column.low, column.high);
    out += fmt::format("  {{ name = \"field_{}\", {} }},  # {}\n", i + 1, place, seen);
  }
  return out;
}

std::string frame_of(const LineKind& kind, std::size_t number) {
  const bool is_summed = kind.checked * 10 > kind.lines * 9;
  const auto usual = std::max_element(kind.counts.begin(), kind.counts.end(),
                                      [](const auto& a, const auto& b) { return a.second < b.second; });
  std::string out = fmt::format("\n[[frame]]  # {} lines\nid = \"{}\"\n", kind.lines, id_of(kind.start, number));
  if (!kind.start.empty()) out += fmt::format("start = {}\n", in_quotes(kind.start));
  const bool is_regular = usual->second * 10 > kind.lines * 9;
  if (kind.start.empty() || (!is_summed && is_regular && usual->first > 0))
    out += fmt::format("fields = {}\n", usual->first);
  out += is_summed ? "checksum = \"nmea\"\n" : "checksum = \"none\"\n";
  return out + "field = [\n" + columns_of(kind) + "]\n";
}

}  // namespace

std::string text_frames(Bytes capture, char& separator) {
  const auto lines = lines_of(capture);
  separator = separator_of(lines);
  std::vector<LineKind> kinds;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const std::string start = start_of(lines[i], separator);
    if (start.size() > 32 || !is_printable(start)) continue;
    auto kind = std::ranges::find_if(kinds, [&](const LineKind& known) { return known.start == start; });
    if (kind == kinds.end()) kind = kinds.insert(kinds.end(), LineKind{start, 0, 0, {}, {}});
    take_line(lines[i], separator, *kind);
  }
  std::erase_if(kinds, [](const LineKind& kind) {
    return kind.lines < kLeastLines || std::all_of(kind.columns.begin(), kind.columns.end(),
                                                   [](const Column& column) { return column.numbers == 0; });
  });
  std::ranges::stable_sort(kinds, std::ranges::greater(), &LineKind::lines);
  if (kinds.size() > kMostKinds) kinds.resize(kMostKinds);
  // Lines that begin with a number would also take any other line with as many fields: they come last.
  std::stable_partition(kinds.begin(), kinds.end(), [](const LineKind& kind) { return !kind.start.empty(); });
  std::string out;
  for (std::size_t i = 0; i < kinds.size(); ++i) out += frame_of(kinds[i], i + 1);
  return out;
}

}  // namespace navcal::analysis
