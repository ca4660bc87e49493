// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

#include "analysis/place_arguments.h"

namespace navcal::cli {

/// Adds --place and --field; --date is the caller's, since it means something else to each command.
void add_place_and_field(CLI::App* command, analysis::PlaceArguments& arguments);

}  // namespace navcal::cli
