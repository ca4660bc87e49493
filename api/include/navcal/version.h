// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <navcal/export.h>

#include <string>

namespace navcal::api {

/// Version of the library in use, as `navcal --version` states it: "0.1.0". Throws nothing but std::bad_alloc.
[[nodiscard]] NAVCAL_API std::string version();

}  // namespace navcal::api
