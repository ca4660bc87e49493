// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "bench/calibration/tables.h"

int main(int argc, char** argv) {
  CLI::App app{"Figures of the calibrators as Markdown tables, ours beside the thesis's and the goals'."};
  navcal::bench::TableOptions options;
  std::vector<std::string> wanted;
  std::string list;
  for (const auto& table : navcal::bench::tables()) {
    list += "\n  " + std::string(table.name) + "  " + std::string(table.description);
  }
  app.add_option("table", wanted, "which tables; all without:" + list);
  app.add_option("--runs", options.runs, "Monte Carlo runs a row")->check(CLI::PositiveNumber);
  app.add_option("--seed", options.seed, "first seed of the table of steps");
  app.footer("Example: bench_calibration gyro --runs 200");
  CLI11_PARSE(app, argc, argv);
  bool found = wanted.empty();
  for (const auto& table : navcal::bench::tables()) {
    if (!wanted.empty() && std::find(wanted.begin(), wanted.end(), table.name) == wanted.end()) continue;
    found = true;
    std::printf("\n### %s\n\n", std::string(table.description).c_str());
    table.print(options);
    std::fflush(stdout);
  }
  if (!found) std::fprintf(stderr, "there is no such table; --help lists them\n");
  return found ? 0 : 2;
}
