// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "protocols/described/description.h"

namespace navcal::protocols::described {

/// A frame with these values, in the units of the description and in the order of its fields; NaN writes what
/// means absent where the description states it, else 0, or nothing in a text. Numbers are rounded to what their
/// type can hold. What the description says nothing of is 0. A frame that states its length has the least one that
/// holds all fields.
[[nodiscard]] std::vector<std::uint8_t> encode(const Description& description, const FrameKind& kind,
                                               std::span<const double> values);

}  // namespace navcal::protocols::described
