// SPDX-License-Identifier: Apache-2.0
#include <navcal/error.h>

namespace navcal::api {

Error::Error(ErrorKind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}

Error::~Error() = default;

}  // namespace navcal::api
