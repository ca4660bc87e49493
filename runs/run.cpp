// SPDX-License-Identifier: Apache-2.0
#include "runs/run.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <vector>

#include "base/angles.h"
#include "base/line_reader.h"

namespace navcal::runs {
namespace {

/// Five seconds at 20 Hz: shorter runs end before the vehicle responds.
constexpr std::size_t kFewestRows = 100;
/// Hours of a run: beyond, the file is no run.
constexpr std::size_t kMostRows = 1'000'000;

std::string_view next_line(std::string_view& rest) {
  const std::size_t end = rest.find('\n');
  const std::string_view line = rest.substr(0, end);
  rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
  return base::trimmed(line, "\r");
}

std::vector<std::string_view> cells_of(std::string_view line) {
  std::vector<std::string_view> cells;
  for (;;) {
    const std::size_t comma = line.find(',');
    cells.push_back(base::trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return cells;
    line.remove_prefix(comma + 1);
  }
}

class RunReader {
 public:
  RunReader(std::string_view text, const std::string& file) : rest_(text), file_(file) {
    if (rest_.starts_with("\xEF\xBB\xBF")) rest_.remove_prefix(3);
  }

  Run read(const std::string& name) {
    find_columns();
    while (!rest_.empty()) read_row();
    if (rows_ < kFewestRows) {
      throw BadRun(fmt::format("{}: {} rows; a run needs {}", file_, rows_, kFewestRows));
    }
    return run(name);
  }

 private:
  struct Column {
    std::string_view name;
    std::size_t place = 0;
    std::vector<double> values;
  };

  [[noreturn]] void fail(std::string_view column, const std::string& what) const {
    throw BadRun(fmt::format("{}:{}: column {}: {}", file_, line_, column, what));
  }

  void find_columns() {
    line_ = 1;
    headings_ = cells_of(next_line(rest_));
    for (Column& column : named_) column.place = place_of(column.name);
    for (int thruster = 1;; ++thruster) {
      const std::string heading = fmt::format("pwm{}", thruster);
      bool there = false;
      for (const std::string_view cell : headings_) there = there || cell == heading;
      if (!there) break;
      commands_.push_back({{}, place_of(heading), {}});
    }
    if (commands_.empty()) fail("pwm1", "missing in the heading");
  }

  std::size_t place_of(std::string_view name) const {
    std::size_t place = headings_.size();
    for (std::size_t i = 0; i < headings_.size(); ++i) {
      if (headings_[i] != name) continue;
      if (place != headings_.size()) fail(name, "twice in the heading");
      place = i;
    }
    if (place == headings_.size()) fail(name, "missing in the heading");
    return place;
  }

  void read_row() {
    ++line_;
    const std::string_view line = next_line(rest_);
    if (base::trimmed(line).empty()) return;
    const std::vector<std::string_view> cells = cells_of(line);
    if (cells.size() != headings_.size()) {
      throw BadRun(fmt::format("{}:{}: {} columns, where the heading has {}", file_, line_, cells.size(),
                               headings_.size()));
    }
    if (++rows_ > kMostRows) throw BadRun(fmt::format("{}:{}: more than {} rows", file_, line_, kMostRows));
    for (Column& column : named_) column.values.push_back(number(cells, column.place));
    for (Column& column : commands_) column.values.push_back(number(cells, column.place));
    named_[kTime].values.back() = second_of_day(named_[kTime].values.back());
  }

  double number(const std::vector<std::string_view>& cells, std::size_t place) const {
    const std::string_view cell = cells[place];
    double value = 0;
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    if (error != std::errc() || end != cell.data() + cell.size() || !std::isfinite(value)) {
      fail(headings_[place], fmt::format("\"{}\" is not a number", cell.substr(0, 40)));
    }
    if (std::abs(value) > 1e7) fail(headings_[place], fmt::format("{} is out of range", cell.substr(0, 40)));
    return value;
  }

  /// Recorders have written second 89 for the end of a minute, so minutes and seconds may pass 59.
  double second_of_day(double hhmmss) const {
    if (hhmmss < 0 || hhmmss >= 250000) fail("time", fmt::format("{} is not HHMMSS", hhmmss));
    const double hour = std::floor(hhmmss / 10000), minute = std::floor(std::fmod(hhmmss, 10000) / 100);
    return 3600 * hour + 60 * minute + std::fmod(hhmmss, 100);
  }

  [[nodiscard]] Eigen::VectorXd vector_of(const Column& column) const {
    return Eigen::Map<const Eigen::VectorXd>(column.values.data(), static_cast<Eigen::Index>(rows_));
  }

  [[nodiscard]] Run run(const std::string& name) const {
    Run run;
    run.name = name;
    run.clock_s = vector_of(named_[kTime]);
    run.depth_m = vector_of(named_[kDepth]);
    run.pressure = vector_of(named_[kPressure]);
    run.battery_V = vector_of(named_[kVoltage]);
    run.roll_rad = vector_of(named_[kRoll]) * base::kRadiansPerDegree;
    run.pitch_rad = vector_of(named_[kPitch]) * base::kRadiansPerDegree;
    run.yaw_rate_rad_s = vector_of(named_[kYawRate]) * base::kRadiansPerDegree;
    run.command_us.resize(run.rows(), static_cast<Eigen::Index>(commands_.size()));
    for (std::size_t i = 0; i < commands_.size(); ++i) {
      run.command_us.col(static_cast<Eigen::Index>(i)) = vector_of(commands_[i]);
    }
    return run;
  }

  enum Place { kTime, kDepth, kPressure, kVoltage, kRoll, kPitch, kYawRate };
  std::string_view rest_;
  const std::string& file_;
  std::size_t line_ = 0, rows_ = 0;
  std::vector<std::string_view> headings_;
  std::array<Column, 7> named_{{{"time", 0, {}},
                                {"depth", 0, {}},
                                {"press", 0, {}},
                                {"voltage", 0, {}},
                                {"roll", 0, {}},
                                {"pitch", 0, {}},
                                {"w_yaw", 0, {}}}};
  std::vector<Column> commands_;
};

}  // namespace

Run read_run(std::string_view text, const std::string& name, const std::string& file) {
  return RunReader(text, file).read(name);
}

}  // namespace navcal::runs
