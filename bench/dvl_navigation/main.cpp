// SPDX-License-Identifier: Apache-2.0
// Position errors on simulated missions with a DVL and without: the table of docs/navigation.md.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "base/angles.h"
#include "bench/dvl_navigation/reckoning_run.h"

namespace navcal::bench {
namespace {

struct Variant {
  const char* name;
  std::optional<DopplerLogOptions> dvl;
};

DopplerLogOptions without_lock(double lost_s, bool through_water) {
  DopplerLogOptions options;
  options.lost_s = lost_s;
  options.through_water = through_water;
  return options;
}

std::array<Variant, 5> variants() {
  return {{{"none", std::nullopt},
           {"bottom", DopplerLogOptions{}},
           {"bottom, lost 60 s of 180 s", without_lock(60, false)},
           {"bottom, lost 60 s of 180 s, water", without_lock(60, true)},
           {"water alone", without_lock(180, true)}}};
}

void print_mission(const std::string& mission, double heading_error_deg, int runs) {
  std::array<ReckoningRun::Outcome, 5> sums{};
  std::array<double, 5> worst_m{};
  for (int run = 0; run < runs; ++run) {
    ReckoningRun::Errors errors;
    errors.heading_error_rad = heading_error_deg * base::kRadiansPerDegree;
    const ReckoningRun reckoning(mission, errors, static_cast<std::uint64_t>(100 + 10 * run));
    for (std::size_t i = 0; i < sums.size(); ++i) {
      const auto outcome = reckoning.reckon(variants()[i].dvl);
      sums[i].per_100_m += outcome.per_100_m * outcome.per_100_m;
      sums[i].error_m += outcome.error_m * outcome.error_m;
      sums[i].way_m += outcome.way_m;
      sums[i].normalised += outcome.normalised;
      worst_m[i] = std::max(worst_m[i], outcome.error_m);
    }
  }
  for (std::size_t i = 0; i < sums.size(); ++i) {
    fmt::print("| {} | {} deg | {} | {:.0f} m | {:.2f} m | {:.1f} m | {:.1f} m | {:.2f} |\n", mission,
               heading_error_deg, variants()[i].name, sums[i].way_m / runs, std::sqrt(sums[i].per_100_m / runs),
               std::sqrt(sums[i].error_m / runs), worst_m[i], sums[i].normalised / runs);
  }
  std::fflush(stdout);
}

int run(int argc, char** argv) {
  CLI::App app{"Position errors on simulated missions with a DVL and without"};
  std::vector<std::string> missions{"survey", "identification", "calibration_swing"};
  int runs = 10;
  app.add_option("MISSION", missions, "Missions of config/missions")->capture_default_str();
  app.add_option("--runs", runs, "Runs of each, with errors of their own")->check(CLI::Range(1, 1000));
  CLI11_PARSE(app, argc, argv);
  fmt::print(
      "| mission | heading error | DVL | way | off per 100 m | at the end | worst | square of error/stated |\n");
  fmt::print("|---|---|---|---|---|---|---|---|\n");
  for (const auto& mission : missions) {
    for (const double heading_error_deg : {1.0, 5.0}) print_mission(mission, heading_error_deg, runs);
  }
  return 0;
}

}  // namespace
}  // namespace navcal::bench

int main(int argc, char** argv) { return navcal::bench::run(argc, argv); }
