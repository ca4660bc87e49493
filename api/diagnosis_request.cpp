// SPDX-License-Identifier: Apache-2.0
#include "api/diagnosis_request.h"

#include <fmt/format.h>
#include <navcal/error.h>

#include <stdexcept>

#include "config/load.h"
#include "config/vehicle_file.h"
#include "emulation/place_arguments.h"
#include "gap/data/silence.h"
#include "gap/thresholds.h"
#include "sim/effects/choice.h"
#include "sim/effects/effect_table.h"

namespace navcal::api {
namespace {

/// Throws Error for a name that is none of an instrument.
std::vector<gap::Quantity> quantities_named(const std::string& name) {
  try {
    return gap::quantities_named(name);
  } catch (const std::invalid_argument& error) {
    throw Error(ErrorKind::bad_argument, fmt::format("without: {}", error.what()));
  }
}

}  // namespace

gap::Request request_of(const std::vector<std::filesystem::path>& missions, const DiagnoseOptions& options,
                        bool is_of_layout) {
  if (missions.empty()) throw Error(ErrorKind::bad_argument, "missions: at least one recording is needed");
  if (!is_of_layout && (!options.nominals.empty() || options.steady))
    throw Error(ErrorKind::bad_argument, "nominals and steady need a layout (vehicle)");
  for (const std::string& name : options.exclude) {
    if (!is_of_layout && !sim::make_effect(name))
      throw Error(ErrorKind::bad_argument, fmt::format("exclude {}: {}", name, sim::unknown_effect(name)));
  }
  if (options.bank < gap::kLeastNulls || options.bank > gap::kMostNulls)
    throw Error(ErrorKind::bad_argument,
                fmt::format("bank: must be {} to {}, not {}", gap::kLeastNulls, gap::kMostNulls, options.bank));
  gap::Request request;
  request.missions = missions;
  request.holdouts = options.holdouts;
  if (!options.config.empty()) request.settings = config::load(options.config);
  if (!is_of_layout && !options.vehicle.empty()) request.vehicle = config::load_vehicle(options.vehicle);
  request.excluded = options.exclude;
  for (const std::string& name : options.without) {
    const auto quantities = quantities_named(name);
    request.without.insert(request.without.end(), quantities.begin(), quantities.end());
  }
  if (const auto& field = options.field_uT) {
    emulation::PlaceArguments where;
    where.field = fmt::format("{},{},{}", (*field)[0], (*field)[1], (*field)[2]);
    request.field_uT = where.field_uT();
  }
  request.cache = options.cache;
  request.bank_missions = options.bank;
  request.bank_seed = options.seed;
  request.threads = options.threads;
  return request;
}

}  // namespace navcal::api
