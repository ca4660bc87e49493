// SPDX-License-Identifier: Apache-2.0
#include "config/network_address.h"

#include <array>
#include <utility>

#include "config/text_rules.h"
#include "protocols/decimal.h"

namespace navcal::config {
namespace {

constexpr std::array<std::pair<std::string_view, NetworkAddress::Kind>, 3> kKinds{{
    {"tcp:", NetworkAddress::Kind::tcp},
    {"tcp-listen:", NetworkAddress::Kind::tcp_listen},
    {"udp:", NetworkAddress::Kind::udp},
}};

}  // namespace

std::optional<SocketAddress> socket_address(std::string_view text) {
  const auto colon = text.rfind(':');
  if (colon == std::string_view::npos) return std::nullopt;
  std::string_view address = text.substr(0, colon);
  const std::string_view port = text.substr(colon + 1);
  if (address.starts_with('[') && address.ends_with(']')) {
    address = address.substr(1, address.size() - 2);
  } else if (address.find(':') != std::string_view::npos) {
    return std::nullopt;
  }
  const auto number = protocols::integer<std::uint16_t>(port);
  if (!number || !is_ip_address(address)) return std::nullopt;
  return SocketAddress{std::string(address), *number};
}

std::optional<NetworkAddress> parse_network_address(std::string_view text) {
  constexpr std::string_view kUnix = "unix-listen:";
  if (text.starts_with(kUnix)) {
    const std::string_view path = text.substr(kUnix.size());
    if (!is_socket_path(path)) return std::nullopt;
    return NetworkAddress{NetworkAddress::Kind::unix_listen, std::string(path), 0};
  }
  for (const auto& [prefix, kind] : kKinds) {
    if (!text.starts_with(prefix)) continue;
    const std::string_view rest = text.substr(prefix.size());
    const auto address = socket_address(rest);
    const bool is_bracketed_v4 =
        address && rest.starts_with('[') && address->address.find(':') == std::string::npos;
    if (!address || address->port == 0 || is_bracketed_v4) return std::nullopt;
    return NetworkAddress{kind, address->address, address->port};
  }
  return std::nullopt;
}

}  // namespace navcal::config
