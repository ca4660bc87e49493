// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "gap/watch/watch.h"

namespace navcal::gap {

/// State of a watch as JSON. `model`: what writer and reader must have in common (watch_model()).
[[nodiscard]] std::string state_text(const Watch::State& state, std::string_view model);

/// Parses a state. Empty for a text that is no state, is one of another model, or contains numbers that are not
/// finite.
[[nodiscard]] std::optional<Watch::State> read_state(std::string_view text, std::string_view model);

/// Text that is equal for watches whose states serve each other: program, what the source says of itself, causes.
[[nodiscard]] std::string watch_model(const WindowSource& source);

}  // namespace navcal::gap
