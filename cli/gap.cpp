// SPDX-License-Identifier: Apache-2.0
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "analysis/output.h"
#include "analysis/progress.h"
#include "cli/commands.h"
#include "cli/gap_layouts.h"
#include "cli/gap_trial.h"
#include "cli/place_options.h"
#include "cli/result_file.h"
#include "config/load.h"
#include "config/vehicle_file.h"
#include "gap/verdict/request.h"
#include "report/gap_effects_file.h"
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
  std::string json, report;
  std::filesystem::path cache;
  int bank_missions = gap::Request{}.bank_missions;
  std::uint64_t bank_seed = gap::Request{}.bank_seed;
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

gap::Diagnosis diagnosis_of(const GapCommandOptions& options) {
  gap::Request request;
  request.mission = options.source.mission;
  request.holdouts.assign(options.source.holdouts.begin(), options.source.holdouts.end());
  if (!options.source.config.empty()) request.settings = config::load(options.source.config);
  if (!options.source.vehicle.empty()) request.vehicle = config::load_vehicle(options.source.vehicle);
  request.excluded = options.source.excluded;
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

void write_answers(const gap::Diagnosis& diagnosis, const GapCommandOptions& options) {
  const auto& source = options.source;
  if (!source.effects_file.empty()) write_result(source.effects_file, report::gap_effects_file(diagnosis));
  if (!options.report.empty()) write_result(options.report, report::gap_page(diagnosis, source));
  if (options.json == "-") return write_to_output(report::gap_json(diagnosis) + '\n');
  if (!options.json.empty()) write_result(options.json, report::gap_json(diagnosis) + '\n');
  write_to_output(report::gap_text(diagnosis, source));
}

void find_gap(const GapCommandOptions& options) {
  try {
    expect_effects(options.source.excluded);
    const auto& source = options.source;
    for (const std::string& file : {options.json, options.report, source.effects_file}) {
      if (!file.empty() && file != "-") expect_folder_of(file);
    }
    std::vector<std::filesystem::path> inputs(source.holdouts.begin(), source.holdouts.end());
    inputs.insert(inputs.end(), {source.mission, source.vehicle, source.config});
    expect_no_overwriting(inputs, {options.json, options.report, source.effects_file});
    write_answers(diagnosis_of(options), options);
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

}  // namespace

void add_gap(CLI::App& app) {
  auto* command = app.add_subcommand(
      "gap", "diagnosis of the gap between a recording and the model: where, from which effect, how much");
  const auto options = std::make_shared<GapCommandOptions>();
  auto& source = options->source;
  command->add_option("FILE", source.mission, "the mission to be diagnosed: a capture (.cap) or a log (.mcap)");
  command
      ->add_option("--holdout", source.holdouts,
                   "another mission of the same vehicle, on which the answer is judged; repeatable")
      ->option_text("FILE")
      ->allow_extra_args(false);
  command->add_option("--vehicle", source.vehicle, "the nominal vehicle, if it is not the reference vehicle")
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
  command->footer(
      "A gap without a known cause (verdict: unknown) is an answer, too: the exit status is 0.\n\n"
      "Example: navcal gap --holdout b.cap --holdout c.cap --report a.html a.cap");
  add_gap_layouts(*command);
  add_gap_trial(*command);
  command->callback([command, options] {
    if (!command->get_subcommands().empty()) return;
    if (options->source.mission.empty()) throw CLI::RequiredError("FILE");
    find_gap(*options);
  });
}

}  // namespace navcal::cli
