// SPDX-License-Identifier: Apache-2.0
#include "web/simulated_track.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <utility>
#include <vector>

namespace navcal::web {
namespace {

constexpr std::size_t kMaxTrackPoints = 4000;

std::vector<std::string_view> cells_of(std::string_view line) {
  if (line.ends_with('\r')) line.remove_suffix(1);
  std::vector<std::string_view> cells;
  for (;;) {
    const auto end = line.find(',');
    cells.push_back(line.substr(0, end));
    if (end == std::string_view::npos) return cells;
    line.remove_prefix(end + 1);
  }
}

/// NaN when the cell is not there or no number.
double cell_number(const std::vector<std::string_view>& cells, std::size_t column) {
  double value = std::nan("");
  if (column < cells.size())
    std::from_chars(cells[column].data(), cells[column].data() + cells[column].size(), value);
  return value;
}

}  // namespace

std::string read_simulated_track(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::string line;
  if (!in || !std::getline(in, line)) throw std::runtime_error(file.string() + ": it cannot be read, or is empty");
  const auto head = cells_of(line);
  const auto column = [&head](std::string_view name) {
    return static_cast<std::size_t>(std::find(head.begin(), head.end(), name) - head.begin());
  };
  const bool is_geographic = column("lat") < head.size() && column("lon") < head.size();
  const std::size_t first = column(is_geographic ? "lat" : "x"), second = column(is_geographic ? "lon" : "y");
  if (first >= head.size() || second >= head.size())
    throw std::runtime_error(file.string() + " line 1: it needs the columns x and y, or lat and lon");
  std::vector<std::pair<double, double>> points;
  for (std::size_t number = 2; std::getline(in, line); ++number) {
    if (line.empty()) continue;
    const auto cells = cells_of(line);
    const double a = cell_number(cells, first), b = cell_number(cells, second);
    if (!std::isfinite(a) || !std::isfinite(b))
      throw std::runtime_error(fmt::format("{} line {}: no number for the place", file.string(), number));
    points.emplace_back(a, b);
  }
  const std::size_t step = points.size() / kMaxTrackPoints + 1;
  std::string out = fmt::format(R"({{"unit":"{}","points":[)", is_geographic ? "deg" : "m");
  for (std::size_t i = 0; i < points.size(); i += step) {
    fmt::format_to(std::back_inserter(out), "{}[{:.7f},{:.7f}]", i == 0 ? "" : ",", points[i].first,
                   points[i].second);
  }
  return out + "]}";
}

}  // namespace navcal::web
