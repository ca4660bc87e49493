// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <optional>

#include "analysis/import/csv_samples.h"
#include "analysis/import/log_readers.h"
#include "base/line_reader.h"
#include "protocols/decimal.h"
#include "record/recording.h"

namespace navcal::analysis {
namespace {

using base::trimmed;
using config::CsvMap;
using config::CsvTime;

/// Cells of one line; a cell in quotes may hold the delimiter. Quotes that are doubled stay doubled.
void split_cells(std::string_view line, char delimiter, std::vector<std::string_view>& cells) {
  cells.clear();
  for (;;) {
    std::string_view rest = trimmed(line);
    std::size_t end = 0;
    if (rest.starts_with('"')) {
      const auto first = static_cast<std::size_t>(rest.data() - line.data());
      const std::size_t close = std::min(line.find('"', first + 1), line.size());
      end = std::min(line.find(delimiter, close), line.size());
      cells.push_back(line.substr(first + 1, close - first - 1));
    } else {
      end = std::min(line.find(delimiter), line.size());
      cells.push_back(trimmed(line.substr(0, end)));
    }
    if (end >= line.size()) return;
    line.remove_prefix(end + 1);
  }
}

/// A decimal number of seconds, milliseconds, ... as nanoseconds, exact to the last digit.
std::optional<std::int64_t> scaled_ns(std::string_view text, int decimals) {
  const bool is_negative = text.starts_with('-');
  if (is_negative) text.remove_prefix(1);
  constexpr std::int64_t kMostValue = INT64_MAX / 10 - 1;
  std::int64_t value = 0;
  bool has_digit = false, is_fraction = false;
  for (const char c : text) {
    if (c == '.' && !is_fraction) {
      is_fraction = true;
      continue;
    }
    if (c < '0' || c > '9' || value > kMostValue) return std::nullopt;
    has_digit = true;
    if (is_fraction && decimals-- <= 0) {
      decimals = 0;
      continue;
    }
    value = value * 10 + (c - '0');
  }
  for (; decimals > 0; --decimals) {
    if (value > kMostValue) return std::nullopt;
    value *= 10;
  }
  if (!has_digit) return std::nullopt;
  return is_negative ? -value : value;
}

std::optional<std::int64_t> patterned_ns(const std::string& text, const std::string& pattern) {
  std::tm time{};
  const char* const rest = ::strptime(text.c_str(), pattern.c_str(), &time);
  if (rest == nullptr) return std::nullopt;
  const std::time_t seconds = ::timegm(&time);
  std::int64_t fraction_ns = 0;
  if (*rest != '\0') {
    const auto found = *rest == '.' || *rest == ',' ? scaled_ns("0." + std::string(rest + 1), 9) : std::nullopt;
    if (!found) return std::nullopt;
    fraction_ns = *found;
  }
  return std::int64_t{seconds} * 1'000'000'000 + fraction_ns;
}

class CsvFile {
 public:
  CsvFile(std::string_view file, const CsvMap& map, ImportSink& sink)
      : file_(file), map_(map), sink_(sink), samples_(map) {
    constexpr std::string_view kMark = "\xEF\xBB\xBF";  // of UTF-8, as spreadsheets write it
    if (file_.starts_with(kMark)) at_ = kMark.size();
  }

  ImportFindings read();

 private:
  /// False at the end.
  bool next_line();
  void read_header();
  [[nodiscard]] std::size_t place_of(const std::string& name) const;
  void take_row(bool is_last);
  [[nodiscard]] std::optional<std::int64_t> time_ns();
  [[nodiscard]] std::optional<double> number(std::string_view cell);

  std::string_view file_;
  const CsvMap& map_;
  ImportSink& sink_;
  CsvSamples samples_;
  ImportFindings findings_;
  std::size_t at_ = 0, line_begin_ = 0;
  std::uint64_t line_number_ = 0;
  std::string_view line_;
  bool is_whole_ = false;  ///< the line has its end
  std::vector<std::string_view> cells_, names_;
  std::vector<std::size_t> time_places_, places_;
  std::size_t width_ = 0;
  std::string text_;
  std::vector<std::optional<double>> values_;
  std::vector<std::uint64_t> beyond_;  ///< values of each column beyond its curve
};

bool CsvFile::next_line() {
  while (at_ < file_.size()) {
    line_begin_ = at_;
    const std::size_t end = file_.find('\n', at_);
    is_whole_ = end != std::string_view::npos;
    line_ = file_.substr(at_, is_whole_ ? end - at_ : std::string_view::npos);
    at_ = is_whole_ ? end + 1 : file_.size();
    ++line_number_;
    if (trimmed(line_).empty() || (!map_.comment.empty() && line_.starts_with(map_.comment))) continue;
    return true;
  }
  return false;
}

std::size_t CsvFile::place_of(const std::string& name) const {
  if (map_.header == 0) {
    const auto number = protocols::integer<std::size_t>(name).value_or(0);
    if (number >= 1 && number <= 10'000) return number - 1;
    throw record::BadRecording(
        fmt::format("the map's column \"{}\": a number is expected, since there is no header", name));
  }
  const auto found = std::find(names_.begin(), names_.end(), name);
  if (found != names_.end()) return static_cast<std::size_t>(found - names_.begin());
  throw record::BadRecording(
      fmt::format("line {}: no column \"{}\"; there are {}", map_.header, name, fmt::join(names_, ", ")));
}

void CsvFile::read_header() {
  if (map_.header > 0) {
    while (line_number_ < static_cast<std::uint64_t>(map_.header)) {
      if (!next_line() || line_number_ > static_cast<std::uint64_t>(map_.header))
        throw record::BadRecording(fmt::format("line {}: no header is there", map_.header));
    }
    split_cells(line_, map_.delimiter, names_);
  }
  for (const auto& name : map_.time_columns) time_places_.push_back(place_of(name));
  for (const auto& column : map_.columns) places_.push_back(place_of(column.name));
  for (const std::size_t place : time_places_) width_ = std::max(width_, place + 1);
  for (const std::size_t place : places_) width_ = std::max(width_, place + 1);
  if (map_.header > 0) width_ = names_.size();
  values_.resize(places_.size());
  beyond_.resize(places_.size());
}

std::optional<double> CsvFile::number(std::string_view cell) {
  if (map_.decimal_comma) {
    text_ = cell;
    std::replace(text_.begin(), text_.end(), ',', '.');
    cell = text_;
  }
  if (cell.starts_with('+')) cell.remove_prefix(1);
  const auto value = protocols::real(cell);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

std::optional<std::int64_t> CsvFile::time_ns() {
  text_.clear();
  for (const std::size_t place : time_places_) {
    if (!text_.empty()) text_ += ' ';
    text_ += cells_[place];
  }
  if (map_.time == CsvTime::iso8601) return config::parse_iso_time(text_);
  if (map_.time == CsvTime::pattern) return patterned_ns(text_, map_.pattern);
  if (map_.decimal_comma) std::replace(text_.begin(), text_.end(), ',', '.');
  constexpr std::array kDecimals{9, 6, 3, 0};
  const auto ns = scaled_ns(text_, kDecimals[static_cast<std::size_t>(map_.time) % kDecimals.size()]);
  return ns && map_.start_ns && map_.time >= CsvTime::s ? std::optional(*ns + *map_.start_ns) : ns;
}

void CsvFile::take_row(bool is_last) {
  split_cells(line_, map_.delimiter, cells_);
  if (cells_.size() < width_) {
    if (is_last && !is_whole_) {
      findings_.cut_at = line_begin_;
    } else {
      sink_.left("row (fewer cells than columns)");
    }
    return;
  }
  const auto time = time_ns();
  if (!time || *time < 0) return sink_.left("row (no time)");
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const std::string_view cell = cells_[places_[i]];
    const auto raw = number(cell);
    if (!raw && !cell.empty()) sink_.left(fmt::format("{} (no number)", map_.columns[i].name));
    values_[i] = raw ? std::optional(map_.columns[i].value(*raw)) : std::nullopt;
    if (raw && map_.columns[i].is_beyond(*raw)) ++beyond_[i];
  }
  samples_.emit(*time, values_, sink_);
}

ImportFindings CsvFile::read() {
  read_header();
  constexpr std::size_t kProgressBytes = 1 << 16;
  std::size_t told = 0;
  findings_.times_are_utc = map_.time < CsvTime::s || map_.time > CsvTime::ns || map_.start_ns.has_value();
  while (next_line()) {
    take_row(at_ == file_.size());
    if (at_ - told >= kProgressBytes) sink_.progress(told = at_);
  }
  for (std::size_t i = 0; i < beyond_.size(); ++i) {
    if (beyond_[i] == 0) continue;
    const config::CsvColumn& column = map_.columns[i];
    findings_.remarks.push_back(fmt::format("{}: {} values lie beyond {} to {}, and count as its ends",
                                            column.name, beyond_[i], column.curve.front().from,
                                            column.curve.back().from));
  }
  return std::move(findings_);
}

}  // namespace

ImportFindings read_csv(std::string_view file, const CsvMap& map, ImportSink& sink) {
  return CsvFile(file, map, sink).read();
}

}  // namespace navcal::analysis
