// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

namespace navcal::cli {

/// `navcal gap layouts`: recordings of vehicles with thrusters whose effects are withheld, and the score of
/// answers to them.
void add_gap_layouts(CLI::App& gap);

}  // namespace navcal::cli
