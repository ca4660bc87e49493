// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "web/http.h"

namespace navcal::web {

/// How BlueOS finds the page of a container: the answer to `GET /register_service`, by its ServiceMetadata.
[[nodiscard]] std::string blueos_service(std::string_view version);
[[nodiscard]] Handler blueos_handler(std::string_view version);

}  // namespace navcal::web
