// SPDX-License-Identifier: Apache-2.0
#include "api/diagnosis_request.h"

#include <fmt/format.h>
#include <navcal/error.h>

#include "config/load.h"
#include "config/vehicle_file.h"
#include "emulation/place_arguments.h"
#include "gap/data/silence.h"
#include "gap/thresholds.h"
#include "sim/effects/choice.h"

namespace navcal::api {

gap::Request request_of(const std::vector<std::filesystem::path>& missions, const DiagnoseOptions& options,
                        bool is_of_layout) {
  if (missions.empty()) throw Error(ErrorKind::bad_argument, "missions: at least one recording is needed");
  if (!is_of_layout) sim::expect_effects(options.exclude);
  if (options.bank < gap::kLeastNulls || options.bank > gap::kMostNulls)
    throw Error(ErrorKind::bad_argument,
                fmt::format("bank: must be {} to {}, not {}", gap::kLeastNulls, gap::kMostNulls, options.bank));
  gap::Request request;
  request.missions = missions;
  request.holdouts = options.holdouts;
  if (!options.config.empty()) request.settings = config::load(options.config);
  if (!is_of_layout && !options.vehicle.empty()) request.vehicle = config::load_vehicle(options.vehicle);
  request.excluded = options.exclude;
  request.without = gap::quantities_of(options.without);
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
