// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "cli/line_socket.h"

namespace navcal::cli {

/// Requests to navcald's control socket, one after the other.
class ControlLink {
 public:
  /// Throws std::runtime_error when there is no daemon.
  explicit ControlLink(const std::filesystem::path& control) : socket_(LineSocket::unix_domain(control)) {}

  /// The daemon's answer to a request that it has granted. Throws analysis::Failure with the daemon's words when
  /// it refuses.
  nlohmann::json ask(const nlohmann::json& request);

 private:
  LineSocket socket_;
};

}  // namespace navcal::cli
