// SPDX-License-Identifier: Apache-2.0
#include <navcal/version.h>

namespace navcal::api {

std::string version() { return NAVCAL_VERSION; }

}  // namespace navcal::api
