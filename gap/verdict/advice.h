// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "sim/effects/description.h"

namespace navcal::gap {

/// Manoeuvres that separate two effects, as text.
[[nodiscard]] std::string tie_breaker(const sim::EffectDescription& one, const sim::EffectDescription& other);

}  // namespace navcal::gap
