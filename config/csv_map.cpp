// SPDX-License-Identifier: Apache-2.0
#include "config/csv_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <numbers>

#include "config/complaints.h"
#include "config/suggestion.h"
#include "protocols/utc.h"

namespace navcal::config {
namespace {

enum class Measure : std::uint8_t {
  angle,
  degrees,
  field,
  rate,
  force,
  length,
  speed,
  pressure,
  turns,
  voltage,
  current,
  anything
};

struct MeaningRow {
  std::string_view name;
  Measure measure;
};

constexpr std::array<MeaningRow, 36> kMeanings{{
    {"heading", Measure::angle},
    {"pitch", Measure::angle},
    {"roll", Measure::angle},
    {"field_x", Measure::field},
    {"field_y", Measure::field},
    {"field_z", Measure::field},
    {"rate_x", Measure::rate},
    {"rate_y", Measure::rate},
    {"rate_z", Measure::rate},
    {"force_x", Measure::force},
    {"force_y", Measure::force},
    {"force_z", Measure::force},
    {"lat", Measure::degrees},
    {"lon", Measure::degrees},
    {"height", Measure::length},
    {"height_msl", Measure::length},
    {"speed", Measure::speed},
    {"course", Measure::angle},
    {"climb", Measure::speed},
    {"depth", Measure::length},
    {"pressure", Measure::pressure},
    {"altitude", Measure::length},
    {"bottom_velocity_x", Measure::speed},
    {"bottom_velocity_y", Measure::speed},
    {"bottom_velocity_z", Measure::speed},
    {"water_velocity_x", Measure::speed},
    {"water_velocity_y", Measure::speed},
    {"water_velocity_z", Measure::speed},
    {"rpm", Measure::turns},
    {"rpm_commanded", Measure::turns},
    {"fin_1", Measure::angle},
    {"fin_2", Measure::angle},
    {"fin_3", Measure::angle},
    {"voltage", Measure::voltage},
    {"current", Measure::current},
    {"sensor", Measure::anything},
}};

struct UnitRow {
  std::string_view name;
  Measure measure;
  double factor;
};

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kStandardGravity_m_s2 = 9.80665;
constexpr double kKnot_m_s = 1852.0 / 3600;
/// The first unit of each measure is navcal's own, and counts where a column states none.
constexpr std::array kUnits{UnitRow{"rad", Measure::angle, 1},
                            UnitRow{"deg", Measure::angle, kDegree},
                            UnitRow{"deg", Measure::degrees, 1},
                            UnitRow{"rad", Measure::degrees, 1 / kDegree},
                            UnitRow{"deg*1e7", Measure::degrees, 1e-7},
                            UnitRow{"uT", Measure::field, 1},
                            UnitRow{"nT", Measure::field, 1e-3},
                            UnitRow{"T", Measure::field, 1e6},
                            UnitRow{"G", Measure::field, 100},
                            UnitRow{"mG", Measure::field, 0.1},
                            UnitRow{"rad/s", Measure::rate, 1},
                            UnitRow{"deg/s", Measure::rate, kDegree},
                            UnitRow{"m/s2", Measure::force, 1},
                            UnitRow{"g", Measure::force, kStandardGravity_m_s2},
                            UnitRow{"mg", Measure::force, kStandardGravity_m_s2 * 1e-3},
                            UnitRow{"m", Measure::length, 1},
                            UnitRow{"cm", Measure::length, 1e-2},
                            UnitRow{"mm", Measure::length, 1e-3},
                            UnitRow{"ft", Measure::length, 0.3048},
                            UnitRow{"m/s", Measure::speed, 1},
                            UnitRow{"cm/s", Measure::speed, 1e-2},
                            UnitRow{"mm/s", Measure::speed, 1e-3},
                            UnitRow{"kn", Measure::speed, kKnot_m_s},
                            UnitRow{"km/h", Measure::speed, 1 / 3.6},
                            UnitRow{"Pa", Measure::pressure, 1},
                            UnitRow{"hPa", Measure::pressure, 100},
                            UnitRow{"mbar", Measure::pressure, 100},
                            UnitRow{"kPa", Measure::pressure, 1e3},
                            UnitRow{"bar", Measure::pressure, 1e5},
                            UnitRow{"dbar", Measure::pressure, 1e4},
                            UnitRow{"rpm", Measure::turns, 1},
                            UnitRow{"rps", Measure::turns, 60},
                            UnitRow{"V", Measure::voltage, 1},
                            UnitRow{"mV", Measure::voltage, 1e-3},
                            UnitRow{"A", Measure::current, 1},
                            UnitRow{"mA", Measure::current, 1e-3}};

constexpr std::array<std::string_view, 9> kTimes{"unix_s", "unix_ms", "unix_us", "unix_ns", "s",
                                                 "ms",     "us",      "ns",      "iso8601"};

std::vector<std::string> units_of(Measure measure) {
  std::vector<std::string> names;
  for (const UnitRow& unit : kUnits) {
    if (unit.measure == measure) names.emplace_back(unit.name);
  }
  return names;
}

template <class T>
const T* value_as(const Entry& entry) {
  return std::get_if<T>(&entry.value);
}

std::optional<double> number_of(const Entry& entry) {
  if (const auto* real = value_as<double>(entry)) return *real;
  if (const auto* whole = value_as<std::int64_t>(entry)) return static_cast<double>(*whole);
  return std::nullopt;
}

/// Reads the entries of a map one after the other.
class MapReader {
 public:
  explicit MapReader(std::vector<Problem>& problems) : problems_(problems) {}

  void take(const Entry& entry) {
    const std::string& head = entry.keys.front();
    if (head == "time") return take_time(entry);
    if (head == "column") return take_column(entry);
    if (entry.keys.size() > 1 || value_as<Table>(entry) != nullptr)
      return complain(entry, "unknown table; known: time, column");
    take_layout(entry);
  }

  CsvMap finish() {
    if (map_.time_columns.empty()) problems_.push_back({1, "time.column", "is missing"});
    if (columns_.empty()) problems_.push_back({1, "column", "a map has a [column.NAME] or more"});
    for (auto& [name, given] : columns_) finish_column(name, given);
    return std::move(map_);
  }

 private:
  struct Given {
    Entry table;
    CsvColumn column;
    bool has_meaning = false;
    std::optional<Entry> unit;
    double scale = 1;
    double offset = 0;
  };

  void take_layout(const Entry& entry) {
    const std::string& key = entry.keys.front();
    const auto* text = value_as<std::string>(entry);
    if (key == "delimiter") {
      if (text != nullptr && *text == "tab") {
        map_.delimiter = '\t';
      } else if (text != nullptr && text->size() == 1) {
        map_.delimiter = text->front();
      } else {
        complain(entry, "one character or \"tab\" is expected");
      }
    } else if (key == "decimal") {
      if (text == nullptr || (*text != "." && *text != ",")) return complain(entry, "\".\" or \",\" is expected");
      map_.decimal_comma = *text == ",";
    } else if (key == "comment") {
      if (text == nullptr) return complain(entry, "a text is expected");
      map_.comment = *text;
    } else if (key == "header") {
      const auto* line = value_as<std::int64_t>(entry);
      if (line == nullptr || *line < 0 || *line > 10'000)
        return complain(entry, "a line number is expected, 0 for none");
      map_.header = static_cast<int>(*line);
    } else {
      complain(entry, "unknown key" + suggestion(key, {"delimiter", "decimal", "comment", "header"}));
    }
  }

  void take_time(const Entry& entry) {
    if (entry.keys.size() == 1) return;
    const std::string& key = entry.keys[1];
    const auto* text = value_as<std::string>(entry);
    if (key == "column") {
      if (text != nullptr) {
        map_.time_columns = {*text};
      } else if (const auto* names = value_as<std::vector<std::string>>(entry);
                 names != nullptr && !names->empty()) {
        map_.time_columns = *names;
      } else {
        complain(entry, "the name of a column is expected, or a list of names");
      }
    } else if (key == "format") {
      if (text == nullptr) return complain(entry, "a text is expected");
      const auto found = std::find(kTimes.begin(), kTimes.end(), *text);
      if (found != kTimes.end()) {
        map_.time = static_cast<CsvTime>(found - kTimes.begin());
      } else if (text->find('%') != std::string::npos) {
        map_.time = CsvTime::pattern;
        map_.pattern = *text;
      } else {
        complain(entry, fmt::format("one of {} is expected, or a pattern such as \"%d/%m/%Y %H:%M:%S\"",
                                    fmt::join(kTimes, ", ")));
      }
    } else if (key == "start") {
      map_.start_ns = text == nullptr ? std::nullopt : parse_iso_time(*text);
      if (!map_.start_ns) complain(entry, "a time such as \"2024-05-01T12:00:00Z\" is expected");
    } else {
      complain(entry, "unknown key" + suggestion(key, {"column", "format", "start"}));
    }
  }

  void take_column(const Entry& entry) {
    if (entry.keys.size() == 1) return;
    Given& given = columns_[entry.keys[1]];
    if (entry.keys.size() == 2) {
      given.table = entry;
      return;
    }
    const std::string& key = entry.keys[2];
    const auto* text = value_as<std::string>(entry);
    const auto number = number_of(entry);
    if (key == "meaning") {
      const auto found = std::find_if(kMeanings.begin(), kMeanings.end(),
                                      [&](const MeaningRow& row) { return text != nullptr && row.name == *text; });
      if (found == kMeanings.end())
        return complain(entry, fmt::format("one of {} is expected", fmt::join(csv_meanings(), ", ")));
      given.column.meaning = static_cast<CsvMeaning>(found - kMeanings.begin());
      given.has_meaning = true;
    } else if (key == "unit" && text != nullptr) {
      given.unit = entry;
    } else if (key == "quantity" && text != nullptr) {
      given.column.quantity = *text;
    } else if (key == "scale" && number && *number != 0) {
      given.scale = *number;
    } else if (key == "offset" && number) {
      given.offset = *number;
    } else if (key == "instance" && value_as<std::int64_t>(entry) != nullptr && *number >= 1 && *number <= 9) {
      given.column.instance = static_cast<int>(*number) - 1;
    } else {
      const std::vector<std::string> known{"meaning", "unit", "quantity", "scale", "offset", "instance"};
      const bool is_known = std::find(known.begin(), known.end(), key) != known.end();
      complain(entry, is_known ? "cannot be " + words_for(entry.value) : "unknown key" + suggestion(key, known));
    }
  }

  void finish_column(const std::string& name, Given& given) {
    if (given.table.keys.empty()) given.table.keys = {"column", name};
    if (!given.has_meaning) return complain(given.table, "meaning is missing");
    const Measure measure = kMeanings[static_cast<std::size_t>(given.column.meaning)].measure;
    CsvColumn column = given.column;
    column.name = name;
    double factor = 1;
    if (measure == Measure::anything) {
      if (column.quantity.empty()) column.quantity = name;
      if (given.unit) column.unit = std::get<std::string>(given.unit->value);
      // A sample keeps this much of them (instruments/samples.h).
      constexpr std::size_t kLongestQuantity = 24, kLongestUnit = 16;
      if (column.quantity.size() > kLongestQuantity || column.unit.size() > kLongestUnit)
        return complain(given.table, fmt::format("quantity has at most {} bytes, unit at most {}",
                                                 kLongestQuantity, kLongestUnit));
    } else if (given.unit) {
      const auto& wanted = std::get<std::string>(given.unit->value);
      const auto found = std::find_if(kUnits.begin(), kUnits.end(), [&](const UnitRow& unit) {
        return unit.measure == measure && unit.name == wanted;
      });
      if (found == kUnits.end())
        return complain(*given.unit, fmt::format("one of {} is expected", fmt::join(units_of(measure), ", ")));
      factor = found->factor;
    }
    column.factor = given.scale * factor;
    column.offset = given.offset * factor;
    map_.columns.push_back(std::move(column));
  }

  void complain(const Entry& entry, std::string message) {
    problems_.push_back({entry.line, entry.name(), std::move(message)});
  }

  std::vector<Problem>& problems_;
  CsvMap map_;
  std::map<std::string, Given> columns_;
};

std::optional<int> digits(std::string_view text, std::size_t first, std::size_t count) {
  if (text.size() < first + count) return std::nullopt;
  int value = 0;
  for (const char c : text.substr(first, count)) {
    if (c < '0' || c > '9') return std::nullopt;
    value = value * 10 + (c - '0');
  }
  return value;
}

/// Nanoseconds of ".25" at the front of `text`, which it takes away.
std::uint32_t take_fraction(std::string_view& text) {
  if (!text.starts_with('.') && !text.starts_with(',')) return 0;
  text.remove_prefix(1);
  std::uint32_t ns = 0;
  for (int i = 0; i < 9; ++i) {
    const bool has_digit = !text.empty() && text.front() >= '0' && text.front() <= '9';
    ns = ns * 10 + (has_digit ? static_cast<std::uint32_t>(text.front() - '0') : 0);
    if (has_digit) text.remove_prefix(1);
  }
  while (!text.empty() && text.front() >= '0' && text.front() <= '9') text.remove_prefix(1);
  return ns;
}

std::optional<std::int64_t> zone_ns(std::string_view text) {
  if (text.empty() || text == "Z") return 0;
  const auto hours = digits(text, 1, 2), minutes = digits(text, text.size() == 6 ? 4 : 3, 2);
  const bool has_sign = text.front() == '+' || text.front() == '-';
  const bool fits = (text.size() == 6 && text[3] == ':') || text.size() == 5;
  if (!has_sign || !fits || !hours || !minutes) return std::nullopt;
  constexpr std::int64_t kMinute_ns = 60'000'000'000;
  return (*hours * 60 + *minutes) * kMinute_ns * (text.front() == '-' ? -1 : 1);
}

}  // namespace

std::vector<std::string> csv_meanings() {
  std::vector<std::string> names;
  for (const MeaningRow& row : kMeanings) names.emplace_back(row.name);
  return names;
}

std::optional<std::int64_t> parse_iso_time(std::string_view text) {
  constexpr std::size_t kSeconds_end = 19;
  const auto date = text.size() < kSeconds_end ? std::nullopt : protocols::parse_iso_date(text.substr(0, 10));
  if (!date || (text[10] != 'T' && text[10] != ' ') || text[13] != ':' || text[16] != ':') return std::nullopt;
  const auto hour = digits(text, 11, 2), minute = digits(text, 14, 2), second = digits(text, 17, 2);
  if (!hour || !minute || !second) return std::nullopt;
  std::string_view rest = text.substr(kSeconds_end);
  const protocols::TimeOfDay time{static_cast<std::uint8_t>(*hour), static_cast<std::uint8_t>(*minute),
                                  static_cast<std::uint8_t>(*second), take_fraction(rest)};
  const auto zone = zone_ns(rest);
  if (!is_valid(time) || !zone) return std::nullopt;
  return unix_ns(*date, time) - *zone;
}

CsvMap parse_csv_map(std::string_view toml, std::string_view name) {
  std::vector<Problem> problems;
  const auto entries = read_document(toml, problems);
  if (!problems.empty()) refuse(problems, name);
  MapReader reader(problems);
  for (const Entry& entry : entries) reader.take(entry);
  CsvMap map = reader.finish();
  refuse(std::move(problems), name);
  return map;
}

CsvMap load_csv_map(const std::filesystem::path& file) { return parse_csv_map(content_of(file), file.string()); }

}  // namespace navcal::config
