// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <string>

#include "analysis/thesis/thesis_results.h"
#include "base/progress.h"
#include "cli/live/commands.h"
#include "cli/live/result_file.h"
#include "report/thesis_page.h"

namespace navcal::cli {
namespace {

struct ThesisCommandOptions {
  analysis::ThesisRequest request;
  std::string page, json;
};

void expect_thesis_outputs(const ThesisCommandOptions& options) {
  if (options.page.empty() && options.json.empty())
    throw base::Failure(base::Exit::usage, "thesis: nothing to write; give --report FILE.html or --json FILE");
  std::vector<std::filesystem::path> inputs;
  for (int number = 1; number <= analysis::kThesisPaths; ++number)
    inputs.push_back(options.request.folder / ("path" + std::to_string(number) + ".csv"));
  expect_results(inputs, {options.page, options.json});
}

void recompute_thesis(ThesisCommandOptions options) {
  if (options.request.folder.empty()) options.request.folder = analysis::thesis_folder();
  expect_thesis_outputs(options);
  const auto results = [&] {
    base::Progress progress("thesis", base::Progress::Answer::at_the_end);
    return analysis::thesis_results(options.request,
                                    [&](std::string_view what, double done) { progress.show(what, done); });
  }();
  if (!options.page.empty()) write_result(options.page, report::thesis_page(results));
  if (!options.json.empty()) give_answer(options.json, report::thesis_json(results), {});
}

}  // namespace

void add_thesis(CLI::App& app) {
  const auto [command, options] = add_command<ThesisCommandOptions>(
      app, "thesis", "tables and figures of the thesis of 2003 recomputed: thesis, navcal, Cramer-Rao bound",
      [](const ThesisCommandOptions& given) { recompute_thesis(given); });
  command->add_option("--report", options->page)->option_text("FILE.html");
  command->add_option("--json", options->json)->option_text("FILE|-");
  command->add_option("--runs", options->request.runs)->check(CLI::Range(2, 100'000))->capture_default_str();
  command->add_option("--seed", options->request.seed)->check(CLI::NonNegativeNumber)->capture_default_str();
  command->add_option("--paths", options->request.folder)->option_text("DIR");
}

}  // namespace navcal::cli
