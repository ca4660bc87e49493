// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "report/simulators/simulator.h"

namespace navcal::report {

/// How well a simulator can have an effect of the library.
enum class Fidelity : std::uint8_t {
  exact,        ///< the same equation, in the simulator's units
  approximate,  ///< nearly the same behaviour, or only some of the parameters; the text says what differs
  none,         ///< not representable; the text says why
};
/// "exact", "approximate", "not representable".
[[nodiscard]] std::string_view name_of(Fidelity fidelity);

/// One cell of the table of effects and simulators.
struct Representation {
  Fidelity fidelity = Fidelity::none;
  std::string_view text;  ///< the conversion, or the reason why there is none; one line of ASCII
};

/// Effects that the table does not know are not representable, and the text says so.
[[nodiscard]] Representation representation_of(std::string_view effect, Simulator simulator);

/// Whether the table has a row of its own for the effect. Effects of noise, clocks and lines need none: no
/// diagnosis names them.
[[nodiscard]] bool has_representation_row(std::string_view effect);

/// All effects in one simulator as a Markdown table: the text of docs/simulator-export.md.
[[nodiscard]] std::string representation_table(Simulator simulator);

}  // namespace navcal::report
