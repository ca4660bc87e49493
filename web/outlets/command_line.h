// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <string_view>

#include "web/outlets/outlet_options.h"

namespace navcal::web {

/// Adds the options of the outlets to navcal-web's command line.
void add_outlet_options(CLI::App& app, OutletOptions& options);

/// Throws CLI::ValidationError for options that do not fit `status`, where navcald is.
void check_outlet_options(const OutletOptions& options, std::string_view status);

}  // namespace navcal::web
