// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "protocols/oncore_position.h"

namespace navcal::protocols::oncore {

/// Eq, the position in ASCII (Motorola M12 user's guide, "ASCII position message"); nullopt when its text cannot
/// be read. Satellites in use are given as tracked. Which height it carries the guide does not say: it is given as
/// the ellipsoid's.
[[nodiscard]] std::optional<Position> decode_eq(Bytes frame);

}  // namespace navcal::protocols::oncore
