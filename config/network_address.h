// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace navcal::config {

struct SocketAddress {
  std::string address;  ///< IPv4 or IPv6 in numbers, or "localhost"; without brackets
  std::uint16_t port = 0;
};
/// "127.0.0.1:2950" or "[::1]:2950"; nullopt when it is no IP address with a port.
[[nodiscard]] std::optional<SocketAddress> socket_address(std::string_view text);

/// Place of a port that is reached through the network instead of a serial line.
struct NetworkAddress {
  enum class Kind : std::uint8_t {
    tcp,          ///< navcald connects, such as to ser2net or to a serial-to-Ethernet converter
    tcp_listen,   ///< the device connects to navcald
    udp,          ///< datagrams that arrive at this address
    unix_listen,  ///< programs on this computer connect to a Unix socket, several at once
  };

  Kind kind = Kind::tcp;
  std::string
      host;  ///< IPv4 or IPv6 in numbers, or "localhost"; without brackets. unix_listen: path of the socket
  std::uint16_t port = 0;  ///< 0 with unix_listen

  bool operator==(const NetworkAddress&) const = default;
};

/// "tcp:192.168.2.2:4001", "tcp-listen:0.0.0.0:4002", "udp:[::1]:4003", "unix-listen:/run/navcal/samples". nullopt
/// when it is none.
[[nodiscard]] std::optional<NetworkAddress> parse_network_address(std::string_view text);

}  // namespace navcal::config
