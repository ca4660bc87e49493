// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace navcal::report {

/// Simulators of other projects for which found effects can be written (docs/simulator-export.md).
enum class Simulator : std::uint8_t { sitl, holoocean, stonefish };
inline constexpr std::array kSimulators{Simulator::sitl, Simulator::holoocean, Simulator::stonefish};

/// Name as users write it: "sitl".
[[nodiscard]] std::string_view name_of(Simulator simulator);
/// Name as a sentence has it: "ArduPilot SITL".
[[nodiscard]] std::string_view title_of(Simulator simulator);
/// Ending of a file for this simulator: ".sitl.parm".
[[nodiscard]] std::string_view ending_of(Simulator simulator);
/// The simulator that users call `name`; empty: there is none.
[[nodiscard]] std::optional<Simulator> simulator_named(std::string_view name);

}  // namespace navcal::report
