// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

#include "web/outlets/outlet_options.h"

namespace navcal::web {

/// Adds the options of the outlets to navcal-web's command line.
void add_outlet_options(CLI::App& app, OutletOptions& options);

}  // namespace navcal::web
