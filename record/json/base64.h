// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace navcal::record {

/// RFC 4648, with padding.
[[nodiscard]] std::string base64(std::string_view bytes);

/// nullopt when it is none.
[[nodiscard]] std::optional<std::string> from_base64(std::string_view text);

}  // namespace navcal::record
