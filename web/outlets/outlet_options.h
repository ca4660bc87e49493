// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace navcal::web {

/// What the command line says of the outlets.
struct OutletOptions {
  std::string version{};
  std::string vessel{};  ///< name of the vessel in Signal K; empty: default_vessel()
};

}  // namespace navcal::web
