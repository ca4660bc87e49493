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

std::optional<config::Layout> layout_of(const GapRequestOptions& options) {
  return emulation::layout_in(options.source.vehicle);
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
  command.add_option("FILE", source.missions,
                     "the mission to be diagnosed: a capture (.cap) or a log (.mcap); several of one vehicle are "
                     "diagnosed together");
  add_window(command, options,
             command.get_name() == "gap"
                 ? ". Without FILE: a diagnosis that --json wrote, for --export and --effects-out"
                 : "");
  add_repeatable(&command, "--holdout", "FILE", source.holdouts,
                 "another mission of the same vehicle, on which the answer is judged; repeatable");
  add_valued(&command, "--vehicle", "FILE.toml", source.vehicle,
             "the nominal vehicle, if it is not the reference vehicle: a vehicle file or a layout");
  add_valued(&command, "--config", "FILE.toml", source.config,
             "configuration of all recordings, instead of their own: ports and instruments");
  add_valued(
      &command, "--field", "N,E,D", options.where.field,
      "the Earth's field in uT (north, east, down), instead of the World Magnetic Model's where the fixes are");
  add_repeatable(&command, "--exclude", "NAME", source.excluded,
                 "removes this effect from the library; repeatable");
  add_repeatable(&command, "--without", "NAME", options.without,
                 "leaves an instrument out of all recordings, as if it were not there: compass, field, tilt, "
                 "card, gyros, accelerometers, depth, gps or motor; repeatable");
  const auto* const bank = "Null bank: simulated nominal missions, which show what is no gap";
  add_number(&command, "--bank", gap::kLeastNulls, gap::kMostNulls, options.bank_missions, "so many")->group(bank);
  add_defaulted(&command, "--seed", options.bank_seed, "seed of their noise and tolerances")->group(bank);
  add_valued(&command, "--cache", "DIR", options.cache, "folder in which they are kept; default: ~/.cache/navcal")
      ->group(bank);
}

}  // namespace navcal::cli
