// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "analysis/thesis/thesis_parts.h"
#include "analysis/thesis/thesis_results.h"

namespace navcal::analysis {

namespace thesis = calib::thesis;
namespace {

/// A path that a figure is drawn of.
struct Drawn {
  int path;
  bool noisy;
};
constexpr std::array kTurnFigures{Drawn{1, false}, Drawn{2, false}, Drawn{3, false},
                                  Drawn{4, false}, Drawn{5, false}, Drawn{6, false},
                                  Drawn{7, false}, Drawn{8, false}, Drawn{3, true}};
constexpr std::array kCompassFigures{Drawn{2, false}, Drawn{4, false}, Drawn{7, false}, Drawn{8, false},
                                     Drawn{8, true}};

/// Tells how far the whole is, by the costs of its parts in any unit.
class Parts {
 public:
  Parts(const ThesisProgress& progress, double whole) : progress_(progress), whole_(whole) {}
  void begin(std::string_view what, double cost) {
    progress_(what, done_ / whole_);
    done_ += cost;
  }

 private:
  const ThesisProgress& progress_;
  double whole_, done_ = 0;
};

/// Measured costs, milliseconds a run.
constexpr double kGyroCost = 1, kCompassCost = 1, kCircleCost = 1, kFieldCost = 1;

void add_traces(ThesisResults& results, const std::array<ThesisPath, kThesisPaths>& paths, std::uint64_t seed) {
  for (const Drawn& drawn : kTurnFigures) {
    const ThesisPath& path = paths.at(static_cast<std::size_t>(drawn.path - 1));
    results.turn_traces.push_back(thesis_turn_trace(path, drawn.path, drawn.noisy, seed));
  }
  for (const Drawn& drawn : kCompassFigures) {
    const ThesisPath& path = paths.at(static_cast<std::size_t>(drawn.path - 1));
    results.compass_traces.push_back(thesis_compass_trace(path, drawn.path, drawn.noisy, seed));
  }
  for (std::size_t row = 0; row < results.circle_traces.size(); ++row)
    results.circle_traces.at(row) = thesis_circle_trace(row, seed);
}

}  // namespace

ThesisResults thesis_results(const ThesisRequest& request, const ThesisProgress& progress) {
  const auto paths = load_thesis_paths(request.folder);
  ThesisResults results;
  results.runs = request.runs;
  results.seed = request.seed;
  results.perfect_error = thesis::table_4_1_statistics(thesis::thesis_deviation().tail<4>());
  Parts parts(progress, kThesisPaths * (kGyroCost + kCompassCost + 2 * kFieldCost) + 5 * kCircleCost);
  auto seed_of = [&, next = std::uint64_t{0}]() mutable { return request.seed * 1000 + next++; };
  for (std::size_t i = 0; i < paths.size(); ++i) {
    parts.begin(fmt::format("gyro, path {}", i + 1), kGyroCost);
    results.gyro.at(i) = thesis_gyro_result(paths.at(i), request.runs, seed_of());
    parts.begin(fmt::format("compass, path {}", i + 1), kCompassCost);
    results.compass.at(i) = thesis_compass_result(paths.at(i), i, request.runs, seed_of());
  }
  for (std::size_t row = 0; row < results.circles.size(); ++row) {
    parts.begin(fmt::format("magnetometer, row {} of table 4.2", row + 1), kCircleCost);
    results.circles.at(row) = thesis_circle_result(row, request.runs, seed_of());
  }
  const std::array fields{thesis::figure_4_11(), thesis::figure_4_12()};
  for (std::size_t f = 0; f < fields.size(); ++f) {
    for (std::size_t i = 0; i < paths.size(); ++i) {
      parts.begin(fmt::format("magnetometer, path {}", i + 1), kFieldCost);
      results.field_paths.at(f).at(i) = thesis_field_path(paths.at(i), fields.at(f), request.runs, seed_of());
    }
  }
  add_traces(results, paths, request.seed);
  results.first_fixes = {thesis_first_fixes(300, 14, request.seed), thesis_first_fixes(600, 29, request.seed)};
  return results;
}

}  // namespace navcal::analysis
