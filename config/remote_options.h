// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "config/options.h"

namespace navcal::config {

/// The table [remote].
[[nodiscard]] std::vector<Option<Settings>> remote_options();

struct SocketAddress {
  std::string address;
  std::uint16_t port = 0;
};
/// "127.0.0.1:2950" or "[::1]:2950"; nullopt when it is no IP address with a port.
[[nodiscard]] std::optional<SocketAddress> socket_address(std::string_view text);

}  // namespace navcal::config
