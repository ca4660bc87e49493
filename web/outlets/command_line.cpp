// SPDX-License-Identifier: Apache-2.0
#include "web/outlets/command_line.h"

#include "web/outlets/signalk.h"

namespace navcal::web {

void add_outlet_options(CLI::App& app, OutletOptions& options) {
  app.add_option("--vessel", options.vessel,
                 "name of the vessel in Signal K, urn:mrn:imo:mmsi:NUMBER or urn:mrn:signalk:uuid:UUID; "
                 "without it one that is derived from this machine")
      ->check(CLI::Validator(problem_of_vessel, "NAME"));
}

}  // namespace navcal::web
