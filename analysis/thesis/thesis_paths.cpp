// SPDX-License-Identifier: Apache-2.0
#include "analysis/thesis/thesis_paths.h"

#include <fmt/format.h>

#include <cmath>
#include <system_error>

#include "base/angles.h"
#include "base/failure.h"
#include "sim/path.h"

namespace navcal::analysis {

namespace thesis = calib::thesis;
namespace {

namespace fs = std::filesystem;

fs::path path_file(const fs::path& folder, int number) { return folder / fmt::format("path{}.csv", number); }

bool has_paths(const fs::path& folder) {
  std::error_code error;
  return fs::exists(path_file(folder, 1), error);
}

void expect_period(const ThesisPath& path, const fs::path& file) {
  constexpr std::size_t kFewest = 100;
  if (path.size() < kFewest)
    throw base::Failure(base::Exit::bad_input, fmt::format("{}: {} rows are too few", file.string(), path.size()));
  for (std::size_t i = 1; i < path.size(); ++i) {
    if (std::abs(path[i].time_s - path[i - 1].time_s - thesis::kPeriod_s) > 1e-6)
      throw base::Failure(base::Exit::bad_input,
                          fmt::format("{}:{}: rows must be 0.1 s apart", file.string(), i + 2));
  }
}

}  // namespace

ThesisPath load_thesis_path(const fs::path& file) {
  ThesisPath path;
  for (const auto& row : sim::load_path(file)) {
    thesis::TruePoint point;
    point.time_s = row.t_s;
    point.position_m = {row.position_m[0], row.position_m[1]};
    point.roll_rad = row.euler_rad[0];
    point.pitch_rad = row.euler_rad[1];
    // Unwrapped whatever the reader made of it.
    const double before = path.empty() ? row.euler_rad[2] : path.back().heading_rad;
    point.heading_rad = before + base::wrapped(row.euler_rad[2] - before);
    point.velocity_body_m_s = {row.velocity_body_m_s[0], row.velocity_body_m_s[1], row.velocity_body_m_s[2]};
    point.rate_rad_s = {row.rate_rad_s[0], row.rate_rad_s[1], row.rate_rad_s[2]};
    path.push_back(point);
  }
  return path;
}

fs::path thesis_folder() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error).parent_path();
  const fs::path installed = (program / "../share/navcal/thesis").lexically_normal();
  const fs::path built = (program / "../share/thesis").lexically_normal();
  for (const fs::path& folder : {installed, built}) {
    if (has_paths(folder)) return folder;
  }
  throw base::Failure(base::Exit::failed,
                      fmt::format("the paths of the thesis (path1.csv to path8.csv) are missing in {}; install "
                                  "them again, or name their folder with --paths",
                                  installed.string()));
}

std::array<ThesisPath, kThesisPaths> load_thesis_paths(const fs::path& folder) {
  std::array<ThesisPath, kThesisPaths> paths;
  for (int number = 1; number <= kThesisPaths; ++number) {
    const fs::path file = path_file(folder, number);
    ThesisPath& path = paths.at(static_cast<std::size_t>(number - 1));
    path = load_thesis_path(file);
    expect_period(path, file);
  }
  return paths;
}

}  // namespace navcal::analysis
