// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "base/progress.h"
#include "cli/gap_request.h"
#include "cli/live/commands.h"
#include "cli/live/exit_statuses.h"
#include "cli/live/result_file.h"
#include "cli/live/shared_options.h"
#include "config/complaints.h"
#include "config/load.h"
#include "config/vehicle_file.h"
#include "devices/instrument_model.h"
#include "diagnosis/diagnose_layout.h"
#include "emulation/chosen_vehicle.h"
#include "gap/verdict/request.h"
#include "record/recording.h"
#include "report/gap_report.h"
#include "report/simulators/transfer.h"

namespace navcal::cli {
namespace {

/// A simulator for which found effects are wanted, and the file for it.
struct ExportFile {
  std::optional<report::Simulator> simulator;  ///< empty: a layout, corrected
  std::filesystem::path file;
};

/// Options --export and --overwrite of `navcal gap`.
struct ExportOptions {
  std::vector<std::string> wanted;  ///< as given: "sitl", "sitl=found.parm"
  bool overwrite = false;
};

namespace fs = std::filesystem;

constexpr std::string_view kLayout = "layout";

std::string known_simulators() {
  std::vector<std::string_view> names;
  for (const auto simulator : report::kSimulators) names.push_back(report::name_of(simulator));
  names.push_back(kLayout);
  return fmt::format("{}", fmt::join(names, ", "));
}

ExportFile export_file(const std::string& wanted, const fs::path& origin) {
  const std::size_t equals = wanted.find('=');
  const std::string name = wanted.substr(0, equals);
  const auto simulator = report::simulator_named(name);
  if (!simulator && name != kLayout) {
    throw base::Failure(base::Exit::usage, fmt::format("--export {}: there is no simulator {}; known are {}",
                                                       wanted, name, known_simulators()));
  }
  if (equals == std::string::npos)
    return {simulator,
            origin.stem().string() + std::string(simulator ? report::ending_of(*simulator) : ".layout.toml")};
  const std::string file = wanted.substr(equals + 1);
  if (file.empty() || file == "-")
    throw base::Failure(base::Exit::usage, fmt::format("--export {}: name a file after =", wanted));
  return {simulator, file};
}

constexpr std::string_view kReplaces = "; --overwrite replaces it";

void add_export_options(CLI::App* command, ExportOptions& options) {
  add_repeatable(command, "--export", "NAME[=FILE]", options.wanted);
  command->add_flag("--overwrite", options.overwrite);
}

/// The files that are wanted. A file that is not named has the name of `origin`, the recording or the saved
/// diagnosis, and stands in the working folder: "a.sitl.parm" for "dives/a.cap". Throws Failure: usage for an
/// unknown simulator, failed for a file that exists and may not be overwritten.
std::vector<ExportFile> export_files(const ExportOptions& options, const fs::path& origin) {
  std::vector<ExportFile> files;
  for (const std::string& wanted : options.wanted) files.push_back(export_file(wanted, origin));
  for (const auto& [simulator, file] : files) {
    expect_folder_of(file);
    if (!options.overwrite) expect_new(file, kReplaces);
  }
  return files;
}

/// Writes the files, and what each contains to standard error. Throws Failure, as export_files(), for a file that
/// has come into being meanwhile, and std::system_error.
void write_exports(const std::vector<ExportFile>& files, const ExportOptions& options,
                   const std::function<report::SimulatorFile(const ExportFile&)>& content_of) {
  for (const auto& one : files) {
    const fs::path& file = one.file;
    const report::SimulatorFile content = content_of(one);
    if (!options.overwrite) expect_new(file, kReplaces);
    write_result(file, content.text);
    std::fputs(fmt::format("navcal: {}: {}\n", file.string(), content.summary).c_str(), stderr);
  }
}

struct GapCommandOptions : GapRequestOptions {
  std::vector<std::string> nominals;
  bool is_steady = false;
  std::string json, report;
  std::string saved;  ///< diagnosis to read instead of making one: --from without a recording
  ExportOptions exports;

  /// File of the diagnosis: the recording, or the saved one.
  [[nodiscard]] std::string origin() const {
    if (!saved.empty()) return saved;
    return source.missions.empty() ? std::string() : source.missions.front();
  }
};

gap::Diagnosis diagnosis_of(const GapCommandOptions& options, const std::optional<config::Layout>& layout) {
  const gap::Request request = gap_request_of(options, layout.has_value());
  base::Progress progress("gap", base::Progress::Answer::at_the_end);
  const auto show = [&](std::string_view what, double done) { progress.show(what, done); };
  if (!layout) return gap::diagnose(request, show);
  return diagnosis::diagnose(request, {.layout = *layout, .excluded = {}, .is_steady = options.is_steady},
                             {options.nominals.begin(), options.nominals.end()}, show);
}

/// Nominal model that the exports correct: with the instruments of --config, else of the recording itself.
report::CorrectedModel corrected_model(const gap::Diagnosis& diagnosis, const GapCommandOptions& options) {
  const auto& source = options.source;
  report::CorrectedModel model{diagnosis, options.origin(), {}, {}};
  if (!source.vehicle.empty()) model.vehicle = config::load_vehicle(source.vehicle);
  if (!source.config.empty()) {
    model.instruments = devices::instrument_model(config::load(source.config));
  } else if (options.saved.empty()) {
    model.instruments = devices::instrument_model(record::Recording::open(source.missions.front())->settings());
  }
  return model;
}

/// Writes the answers that a saved diagnosis gives as well.
void write_models(const gap::Diagnosis& diagnosis, const GapCommandOptions& options,
                  const std::optional<config::Layout>& layout, const std::vector<ExportFile>& exports) {
  const auto& source = options.source;
  if (!source.effects_file.empty()) write_result(source.effects_file, report::gap_effects_file(diagnosis));
  if (exports.empty()) return;
  if (layout) {
    write_exports(exports, options.exports,
                  [&](const auto&) { return report::corrected_layout(diagnosis, options.origin(), *layout); });
  } else {
    const report::CorrectedModel model = corrected_model(diagnosis, options);
    write_exports(exports, options.exports,
                  [&](const ExportFile& one) { return report::simulator_file(*one.simulator, model); });
  }
}

void write_answers(const gap::Diagnosis& diagnosis, const GapCommandOptions& options) {
  const auto& source = options.source;
  if (!options.report.empty()) write_result(options.report, report::gap_page(diagnosis, source));
  give_answer(options.json, options.json.empty() ? std::string() : report::gap_json(diagnosis) + '\n',
              report::gap_text(diagnosis, source));
}

/// Checks what can be checked before the work. Throws Failure.
std::vector<ExportFile> expect_outputs(const GapCommandOptions& options, bool has_layout) {
  const auto& source = options.source;
  std::vector<std::filesystem::path> outputs{options.json, options.report, source.effects_file};
  std::vector<ExportFile> exports = export_files(options.exports, options.origin());
  for (const auto& [simulator, file] : exports) {
    outputs.push_back(file);
    if (simulator.has_value() == has_layout)
      throw base::Failure(base::Exit::usage,
                          has_layout
                              ? "--export: of a layout only the layout itself can be written: --export layout"
                              : "--export layout needs a layout (--vehicle)");
  }
  expect_results(all_paths({source.holdouts, options.nominals, source.missions},
                           {options.origin(), source.vehicle, source.config}),
                 outputs);
  return exports;
}

void find_gap(const GapCommandOptions& options) {
  with_exit_statuses([&] {
    (void)gap::quantities_of(options.without);
    // Only exports want it of a saved diagnosis.
    const auto layout =
        options.saved.empty() || !options.exports.wanted.empty()
            ? emulation::layout_to_diagnose(options.source.vehicle, !options.nominals.empty() || options.is_steady)
            : std::nullopt;
    const std::vector<ExportFile> exports = expect_outputs(options, layout.has_value());
    const gap::Diagnosis diagnosis = options.saved.empty()
                                         ? diagnosis_of(options, layout)
                                         : report::gap_from_json(config::content_of(options.saved), options.saved);
    write_models(diagnosis, options, layout, exports);
    if (options.saved.empty()) write_answers(diagnosis, options);
  });
}

/// A saved diagnosis is there to be exported. Throws CLI::ParseError.
void expect_export(const CLI::App& command, const GapCommandOptions& options) {
  if (options.exports.wanted.empty() && options.source.effects_file.empty())
    throw CLI::RequiredError("--from: --export or --effects-out");
  for (const char* other :
       {"--holdout", "--field", "--exclude", "--json", "--report", "--bank", "--seed", "--cache", "--to"}) {
    if (command.count(other) > 0) throw CLI::ExcludesError("--from", other);
  }
}

}  // namespace

void add_gap(CLI::App& app) {
  auto* command = app.add_subcommand(
      "gap", "diagnosis of the gap between a recording and the model: where, from which effect, how much");
  const auto options = std::make_shared<GapCommandOptions>();
  auto& source = options->source;
  add_gap_request(*command, *options);
  add_repeatable(command, "--nominal", "FILE", options->nominals);
  command->add_flag("--steady", options->is_steady);
  add_valued(command, "--json", "FILE|-", options->json);
  add_valued(command, "--report", "FILE.html", options->report);
  add_valued(command, "--effects-out", "FILE.toml", source.effects_file);
  add_export_options(command, options->exports);
  add_gap_next(*command);
  add_gap_watch(*command);
  add_gap_trial(*command);
  // navcal research lists it.
  command->get_subcommand("trial")->group("");
  command->callback([command, options] {
    if (!command->get_subcommands().empty()) return;
    if (options->source.missions.empty()) options->saved = options->from;
    if (options->origin().empty()) throw CLI::RequiredError("FILE");
    if (!options->saved.empty()) expect_export(*command, *options);
    find_gap(*options);
  });
}

}  // namespace navcal::cli
