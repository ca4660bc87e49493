// SPDX-License-Identifier: Apache-2.0
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "analysis/chosen_vehicle.h"
#include "analysis/output.h"
#include "analysis/progress.h"
#include "cli/commands.h"
#include "cli/gap_export.h"
#include "cli/gap_layouts.h"
#include "cli/gap_next.h"
#include "cli/gap_trial.h"
#include "cli/place_options.h"
#include "cli/result_file.h"
#include "config/load.h"
#include "config/vehicle_file.h"
#include "devices/instrument_model.h"
#include "diagnosis/diagnose_layout.h"
#include "gap/verdict/request.h"
#include "record/recording.h"
#include "report/gap_effects_file.h"
#include "report/gap_from_json.h"
#include "report/gap_json.h"
#include "report/gap_page.h"
#include "report/gap_text.h"
#include "sim/effects/choice.h"
#include "sim/effects/effect_table.h"

namespace navcal::cli {
namespace {

struct GapCommandOptions {
  report::GapSource source;
  analysis::PlaceArguments where;
  std::vector<std::string> nominals;
  std::string json, report;
  std::vector<std::string> without;
  std::string saved;  ///< diagnosis to read instead of making one
  ExportOptions exports;
  std::filesystem::path cache;
  int bank_missions = gap::Request{}.bank_missions;
  std::uint64_t bank_seed = gap::Request{}.bank_seed;

  /// File of the diagnosis: the recording, or the saved one.
  [[nodiscard]] const std::string& origin() const { return saved.empty() ? source.mission : saved; }
};

/// Where the user's caches are, after the XDG base directories; empty when there is no such place.
std::filesystem::path usual_cache() {
  const auto folder = [](const char* variable) {
    const char* const value = std::getenv(variable);
    return std::filesystem::path(value == nullptr ? "" : value);
  };
  if (const auto caches = folder("XDG_CACHE_HOME"); caches.is_absolute()) return caches / "navcal";
  if (const auto home = folder("HOME"); home.is_absolute()) return home / ".cache" / "navcal";
  return {};
}

void expect_effects(const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    if (!sim::make_effect(name))
      throw analysis::Failure(analysis::Exit::usage, "--exclude " + name + ": " + sim::unknown_effect(name));
  }
}

void expect_instrument(const std::string& name) {
  try {
    static_cast<void>(gap::quantities_named(name));
  } catch (const std::invalid_argument& error) {
    throw analysis::Failure(analysis::Exit::usage, std::string("--without: ") + error.what());
  }
}

/// The diagnosis of a vehicle that a layout describes.
gap::Diagnosis diagnosis_of(const GapCommandOptions& options, const config::Layout& layout) {
  if (options.where.field_uT())
    throw std::invalid_argument(
        "--field: the diagnosis of a layout takes the heading's offset from each recording");
  diagnosis::LayoutFiles files{.recording = options.source.mission,
                               .holdouts = {options.source.holdouts.begin(), options.source.holdouts.end()},
                               .nominals = {options.nominals.begin(), options.nominals.end()},
                               .settings = {}};
  if (!options.source.config.empty()) files.settings = config::load(options.source.config);
  diagnosis::LayoutRequest request{.layout = layout, .excluded = options.source.excluded};
  if (options.bank_missions != gap::Request{}.bank_missions) request.simulated_nominals = options.bank_missions;
  request.seed = options.bank_seed;
  analysis::Progress progress("gap", analysis::Progress::Answer::at_the_end);
  const auto show = [&](std::string_view what, double done) { progress.show(what, done); };
  return diagnosis::diagnose(request, diagnosis::load(files, show), show);
}

gap::Diagnosis diagnosis_of(const GapCommandOptions& options) {
  gap::Request request;
  if (!options.source.vehicle.empty()) {
    const analysis::ChosenVehicle vehicle = analysis::load_chosen_vehicle(options.source.vehicle);
    if (const auto* layout = std::get_if<config::Layout>(&vehicle)) return diagnosis_of(options, *layout);
    request.vehicle = std::get<config::VehicleSettings>(vehicle);
  }
  if (!options.nominals.empty())
    throw std::invalid_argument(
        "--nominal needs a layout (--vehicle): the floor of the reference vehicle is simulated");
  expect_effects(options.source.excluded);
  request.mission = options.source.mission;
  request.holdouts.assign(options.source.holdouts.begin(), options.source.holdouts.end());
  if (!options.source.config.empty()) request.settings = config::load(options.source.config);
  request.excluded = options.source.excluded;
  for (const std::string& name : options.without) {
    const auto quantities = gap::quantities_named(name);
    request.without.insert(request.without.end(), quantities.begin(), quantities.end());
  }
  request.field_uT = options.where.field_uT();
  request.cache = options.cache.empty() ? usual_cache() : options.cache;
  request.bank_missions = options.bank_missions;
  request.bank_seed = options.bank_seed;
  analysis::Progress progress("gap", analysis::Progress::Answer::at_the_end);
  return gap::diagnose(request, [&](std::string_view what, double done) { progress.show(what, done); });
}

void write_to_output(std::string_view text) {
  analysis::Output output(STDOUT_FILENO, "standard output");
  output.append(text);
  output.flush();
}

/// Nominal model that the exports correct: with the instruments of --config, else of the recording itself.
report::CorrectedModel corrected_model(const gap::Diagnosis& diagnosis, const GapCommandOptions& options) {
  const auto& source = options.source;
  report::CorrectedModel model{diagnosis, options.origin(), {}, {}};
  if (!source.vehicle.empty()) model.vehicle = config::load_vehicle(source.vehicle);
  if (!source.config.empty()) {
    model.instruments = devices::instrument_model(config::load(source.config));
  } else if (options.saved.empty()) {
    model.instruments = devices::instrument_model(record::Recording::open(source.mission)->settings());
  }
  return model;
}

/// Writes the answers that a saved diagnosis gives as well.
void write_models(const gap::Diagnosis& diagnosis, const GapCommandOptions& options,
                  const std::vector<ExportFile>& exports) {
  const auto& source = options.source;
  if (!source.effects_file.empty()) write_result(source.effects_file, report::gap_effects_file(diagnosis));
  if (!exports.empty()) write_exports(exports, options.exports, corrected_model(diagnosis, options));
}

void write_answers(const gap::Diagnosis& diagnosis, const GapCommandOptions& options) {
  const auto& source = options.source;
  if (!options.report.empty()) write_result(options.report, report::gap_page(diagnosis, source));
  if (options.json == "-") return write_to_output(report::gap_json(diagnosis) + '\n');
  if (!options.json.empty()) write_result(options.json, report::gap_json(diagnosis) + '\n');
  write_to_output(report::gap_text(diagnosis, source));
}

gap::Diagnosis saved_diagnosis(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw std::system_error(errno, std::system_category(), file);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  if (stream.bad()) throw std::system_error(errno, std::system_category(), file);
  return report::gap_from_json(text, file);
}

/// Checks what can be checked before the work. Throws Failure.
std::vector<ExportFile> expect_outputs(const GapCommandOptions& options) {
  const auto& source = options.source;
  std::vector<std::filesystem::path> outputs{options.json, options.report, source.effects_file};
  for (const auto& file : outputs) {
    if (!file.empty() && file != "-") expect_folder_of(file);
  }
  std::vector<ExportFile> exports = export_files(options.exports, options.origin());
  for (const auto& [simulator, file] : exports) outputs.push_back(file);
  std::vector<std::filesystem::path> inputs(source.holdouts.begin(), source.holdouts.end());
  inputs.insert(inputs.end(), options.nominals.begin(), options.nominals.end());
  inputs.insert(inputs.end(), {options.origin(), source.vehicle, source.config});
  expect_no_overwriting(inputs, outputs);
  return exports;
}

void find_gap(const GapCommandOptions& options) {
  try {
    for (const std::string& name : options.without) expect_instrument(name);
    const std::vector<ExportFile> exports = expect_outputs(options);
    const gap::Diagnosis diagnosis =
        options.saved.empty() ? diagnosis_of(options) : saved_diagnosis(options.saved);
    write_models(diagnosis, options, exports);
    if (options.saved.empty()) write_answers(diagnosis, options);
  } catch (const report::BadDiagnosis& error) {
    throw analysis::Failure(analysis::Exit::bad_input, error.what());
  } catch (const record::BadRecording& error) {
    throw analysis::Failure(analysis::Exit::bad_input, error.what());
  } catch (const config::Error& error) {
    throw analysis::Failure(analysis::Exit::bad_input, error.what());
  } catch (const std::invalid_argument& error) {
    throw analysis::Failure(analysis::Exit::usage, error.what());
  } catch (const std::system_error& error) {
    throw analysis::Failure(analysis::Exit::failed, error.what());
  }
}

/// Adds the options by which found effects become files for simulators, also of a diagnosis that is saved.
void add_exports(CLI::App* command, CLI::Option* mission, GapCommandOptions& options) {
  add_export_options(command, options.exports);
  auto* const saved =
      command
          ->add_option("--from", options.saved,
                       "a diagnosis that --json wrote, instead of a recording; for --export and --effects-out")
          ->option_text("FILE.json")
          ->excludes(mission);
  for (const char* other :
       {"--holdout", "--field", "--exclude", "--json", "--report", "--bank", "--seed", "--cache"})
    saved->excludes(command->get_option(other));
}

}  // namespace

void add_gap(CLI::App& app) {
  auto* command = app.add_subcommand(
      "gap", "diagnosis of the gap between a recording and the model: where, from which effect, how much");
  const auto options = std::make_shared<GapCommandOptions>();
  auto& source = options->source;
  auto* const mission = command->add_option("FILE", source.mission,
                                            "the mission to be diagnosed: a capture (.cap) or a log (.mcap)");
  command
      ->add_option("--holdout", source.holdouts,
                   "another mission of the same vehicle, on which the answer is judged; repeatable")
      ->option_text("FILE")
      ->allow_extra_args(false);
  command
      ->add_option(
          "--nominal", options->nominals,
          "a recording of the same vehicle without a gap, which shows what is no gap; only with a layout; "
          "repeatable")
      ->option_text("FILE")
      ->allow_extra_args(false);
  command
      ->add_option("--vehicle", source.vehicle,
                   "the nominal vehicle, if it is not the reference vehicle: a vehicle file or a layout")
      ->option_text("FILE.toml");
  command
      ->add_option("--config", source.config,
                   "configuration of all recordings, instead of their own: ports and instruments")
      ->option_text("FILE.toml");
  command
      ->add_option("--field", options->where.field,
                   "the Earth's field in uT (north, east, down), instead of the World Magnetic Model's where the "
                   "fixes are")
      ->option_text("N,E,D");
  command->add_option("--exclude", source.excluded, "removes this effect from the library; repeatable")
      ->option_text("NAME")
      ->allow_extra_args(false);
  command
      ->add_option(
          "--without", options->without,
          "leaves an instrument out of all recordings, as if it were not there: compass, field, tilt, card, "
          "gyros, accelerometers, depth, gps or motor; repeatable")
      ->option_text("NAME")
      ->allow_extra_args(false);
  command->add_option("--json", options->json, "the answer as one JSON object; - is standard output, without text")
      ->option_text("FILE|-");
  command->add_option("--report", options->report, "page with pictures; needs no other file")
      ->option_text("FILE.html");
  command->add_option("--effects-out", source.effects_file, "the effects found, for navcal simulate --effects")
      ->option_text("FILE.toml");
  const auto* const bank = "Null bank: simulated nominal missions, which show what is no gap";
  command->add_option("--bank", options->bank_missions, "so many")
      ->check(CLI::Range(2, 10'000))
      ->capture_default_str()
      ->group(bank);
  command->add_option("--seed", options->bank_seed, "seed of their noise and tolerances")
      ->capture_default_str()
      ->group(bank);
  command->add_option("--cache", options->cache, "folder in which they are kept; default: ~/.cache/navcal")
      ->option_text("DIR")
      ->group(bank);
  add_exports(command, mission, *options);
  command->footer(
      "A gap without a known cause (verdict: unknown) is an answer, too: the exit status is 0.\n\n"
      "Example: navcal gap --holdout b.cap --holdout c.cap --report a.html --export sitl=a.parm a.cap");
  add_gap_layouts(*command);
  add_gap_next(*command, usual_cache());
  add_gap_trial(*command);
  command->callback([command, options] {
    if (!command->get_subcommands().empty()) return;
    if (options->origin().empty()) throw CLI::RequiredError("FILE");
    if (!options->saved.empty() && options->exports.wanted.empty() && options->source.effects_file.empty())
      throw CLI::RequiredError("--from: --export or --effects-out");
    find_gap(*options);
  });
}

}  // namespace navcal::cli
