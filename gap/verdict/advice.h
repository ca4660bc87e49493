// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "sim/effects/description.h"

namespace navcal::gap {

/// The manoeuvres that tell two effects apart, for people.
[[nodiscard]] std::string tie_breaker(const sim::EffectDescription& one, const sim::EffectDescription& other);

}  // namespace navcal::gap
