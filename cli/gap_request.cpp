// SPDX-License-Identifier: Apache-2.0
#include "cli/gap_request.h"

#include <cstdlib>
#include <variant>

#include "cli/live/option_kinds.h"
#include "config/load.h"
#include "emulation/chosen_vehicle.h"
#include "gap/data/silence.h"
#include "gap/thresholds.h"
#include "sim/effects/choice.h"

namespace navcal::cli {

std::filesystem::path usual_cache() {
  const auto folder = [](const char* variable) {
    const char* const value = std::getenv(variable);
    return std::filesystem::path(value == nullptr ? "" : value);
  };
  if (const auto caches = folder("XDG_CACHE_HOME"); caches.is_absolute()) return caches / "navcal";
  if (const auto home = folder("HOME"); home.is_absolute()) return home / ".cache" / "navcal";
  return {};
}

gap::Request gap_request_of(const GapRequestOptions& options, bool is_of_layout) {
  gap::Request request;
  if (!options.source.vehicle.empty() && !is_of_layout) {
    request.vehicle = std::get<config::VehicleSettings>(emulation::load_chosen_vehicle(options.source.vehicle));
  }
  if (!is_of_layout) sim::expect_effects(options.source.excluded);
  request.missions = {options.source.missions.begin(), options.source.missions.end()};
  request.holdouts.assign(options.source.holdouts.begin(), options.source.holdouts.end());
  if (!options.source.config.empty()) request.settings = config::load(options.source.config);
  request.excluded = options.source.excluded;
  request.window = options.window();
  request.without = gap::quantities_of(options.without);
  request.field_uT = options.where.field_uT();
  request.cache = options.cache.empty() ? usual_cache() : options.cache;
  request.bank_missions = options.bank_missions;
  request.bank_seed = options.bank_seed;
  return request;
}

void add_gap_request(CLI::App& command, GapRequestOptions& options) {
  auto& source = options.source;
  command.add_option("FILE", source.missions);
  add_window(command, options,
             command.get_name() == "gap"
                 ? ". Without FILE: a diagnosis that --json wrote, for --export and --effects-out"
                 : "");
  add_repeatable(&command, "--holdout", "FILE", source.holdouts);
  add_valued(&command, "--vehicle", "FILE.toml", source.vehicle);
  add_valued(&command, "--config", "FILE.toml", source.config);
  add_valued(&command, "--field", "N,E,D", options.where.field);
  add_repeatable(&command, "--exclude", "NAME", source.excluded);
  add_repeatable(&command, "--without", "NAME", options.without);
  const auto* const bank = "Null bank: simulated nominal missions, which show what is no gap";
  add_number(&command, "--bank", gap::kLeastNulls, gap::kMostNulls, options.bank_missions)->group(bank);
  add_defaulted(&command, "--seed", options.bank_seed)->group(bank);
  add_valued(&command, "--cache", "DIR", options.cache)->group(bank);
}

}  // namespace navcal::cli
