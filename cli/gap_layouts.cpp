// SPDX-License-Identifier: Apache-2.0

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>

#include "base/failure.h"
#include "base/interruptible.h"
#include "base/progress.h"
#include "cli/live/commands.h"
#include "cli/live/exit_statuses.h"
#include "cli/live/result_file.h"
#include "report/layout_score_report.h"
#include "validation/layout_recordings.h"

namespace navcal::cli {
namespace {

struct GapLayoutsScoreArguments {
  std::string answers, truth, json;
};

struct GapLayoutsRecordArguments {
  std::vector<std::string> layouts;
  validation::LayoutRecordingsOptions options;
};

void record_layouts(GapLayoutsRecordArguments arguments) {
  validation::LayoutRecordingsOptions& options = arguments.options;
  with_exit_statuses(
      [&] {
        for (const std::string& file : arguments.layouts)
          options.layouts.push_back({std::filesystem::path(file).filename().string(), read_file(file)});
        expect_folder_of(options.truth);
        const base::Interruptible interruptible;
        base::Progress progress("gap layouts record");
        validation::write_layout_recordings(options, [&](double share) { progress.show(share); });
      },
      base::Exit::bad_input);
  fmt::print("{} recordings in {}, truth in {}\n",
             options.vehicles * options.nominal + validation::kRecordingsPerCase * options.cases,
             options.folder.string(), options.truth.string());
}

/// What `work` gives; what it does not understand is the fault of a file.
template <class Work>
auto blaming(const std::string& file, const Work& work) {
  try {
    return work();
  } catch (const std::runtime_error& error) {
    throw base::Failure(base::Exit::bad_input, file + ": " + error.what());
  }
}

void score_layouts(const GapLayoutsScoreArguments& arguments) {
  const std::string truth = read_file(arguments.truth);
  const auto truths = blaming(arguments.truth, [&] { return validation::read_layout_truths(truth); });
  const std::string answer = read_file(arguments.answers);
  const validation::LayoutScores scores = blaming(arguments.answers, [&] {
    return validation::layout_scores(truths, validation::read_layout_answers(answer));
  });
  if (arguments.json != "-") fmt::print("{}", report::layout_score_text(scores));
  if (arguments.json == "-") fmt::print("{}", report::layout_score_json(scores));
  if (!arguments.json.empty() && arguments.json != "-")
    write_result(arguments.json, report::layout_score_json(scores));
}

void add_record(CLI::App& layouts) {
  auto* command = layouts.add_subcommand("record", "recordings by the reference simulator, with the truth apart");
  const auto arguments = std::make_shared<GapLayoutsRecordArguments>();
  auto& options = arguments->options;
  add_repeatable(command, "--layout", "FILE.toml", arguments->layouts,
                 "a layout whose actuators are thrusters, up to eight; repeatable, vehicles take them by turns")
      ->required();
  add_valued(command, "-o,--output", "DIR", options.folder, "folder for the recordings; a new or an empty one")
      ->required();
  add_valued(command, "--truth", "FILE.jsonl", options.truth, "file for the truth, outside that folder")
      ->required();
  add_defaulted(command, "--seed", options.seed, "seed of vehicles, places, effects, missions and noise");
  add_number(command, "--vehicles", 1, 1000, options.vehicles, "number of vehicles");
  add_number(command, "--nominal", 0, 100, options.nominal, "recordings without an effect, of each vehicle");
  add_number(command, "--cases", 0, 9999, options.cases,
             "number of cases; each has three recordings of one vehicle");
  add_number(command, "--minutes", 0.75, 60.0, options.minutes, "length of a recording");
  add_number(command, "--layout-error", 0.0, 0.2, options.errors.layout,
             "how far the vehicles are off their layouts, one standard deviation");
  add_number(command, "--unmodelled", 0.0, 10.0, options.errors.unmodelled,
             "factor on what no layout has a number for: wakes, flow across rotors, drag along the hull, swell");
  command->footer(
      "Example: navcal research gap-layouts record --layout /usr/share/navcal/vehicles/bluerov2-heavy.toml -o "
      "recordings "
      "--truth truth.jsonl");
  command->callback([arguments] { record_layouts(*arguments); });
}

void add_score(CLI::App& layouts) {
  auto* command = layouts.add_subcommand("score", "score of answers, a line of JSON for each case");
  const auto arguments = std::make_shared<GapLayoutsScoreArguments>();
  command->add_option("ANSWERS", arguments->answers, "lines of JSON: {\"case\":\"0001\", what navcal gap prints}")
      ->required();
  add_valued(command, "--truth", "FILE.jsonl", arguments->truth, "the truth that was written with the recordings")
      ->required();
  add_valued(command, "--json", "FILE|-", arguments->json,
             "the scores as one JSON object; - is standard output, without text");
  command->footer("Example: navcal research gap-layouts score answers.jsonl --truth truth.jsonl");
  command->callback([arguments] { score_layouts(*arguments); });
}

}  // namespace

void add_gap_layouts(CLI::App& gap) {
  auto* command =
      gap.add_subcommand("layouts", "blind validation on vehicles with thrusters: recordings and score");
  command->require_subcommand(1);
  command->footer("Example: navcal research gap-layouts score answers.jsonl --truth truth.jsonl");
  add_record(*command);
  add_score(*command);
}

}  // namespace navcal::cli
