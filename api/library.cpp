// SPDX-License-Identifier: Apache-2.0
#include <navcal/error.h>
#include <navcal/version.h>

namespace navcal::api {

Error::Error(ErrorKind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}
Error::~Error() = default;

std::string version() { return NAVCAL_VERSION; }

}  // namespace navcal::api
