// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>

namespace navcal::daemon {

/// The daemon cannot start; what() says why and what would help.
class StartError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace navcal::daemon
