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

/// How well a simulator can have an effect of the library.
enum class Fidelity : std::uint8_t {
  exact,        ///< the same equation, in the simulator's units
  approximate,  ///< nearly the same behaviour, or only some of the parameters; the text says what differs
  none,         ///< not representable; the text says why
};

/// One cell of the table of effects and simulators.
struct Representation {
  Fidelity fidelity = Fidelity::none;
  std::string_view text;  ///< the conversion, or the reason why there is none; one line of ASCII
};

/// Effects that the table does not know are not representable, and the text says so.
[[nodiscard]] Representation representation_of(std::string_view effect, Simulator simulator);

}  // namespace navcal::report
