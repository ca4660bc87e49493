// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace navcal::gap {

/// The manoeuvre in which an effect shows as nothing else does.
[[nodiscard]] std::string_view telling_manoeuvre(std::string_view effect);

/// What tells two effects apart, for people.
[[nodiscard]] std::string tie_breaker(std::string_view one, std::string_view other);

}  // namespace navcal::gap
