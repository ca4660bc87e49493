// SPDX-License-Identifier: Apache-2.0
#include "config/network_address.h"

#include <array>
#include <charconv>
#include <utility>

#include "config/text_rules.h"

namespace navcal::config {
namespace {

constexpr std::array<std::pair<std::string_view, NetworkAddress::Kind>, 3> kKinds{{
    {"tcp:", NetworkAddress::Kind::tcp},
    {"tcp-listen:", NetworkAddress::Kind::tcp_listen},
    {"udp:", NetworkAddress::Kind::udp},
}};

/// IPv6 addresses contain colons themselves, so they stand in brackets.
std::optional<std::string_view> without_brackets(std::string_view host) {
  if (!host.starts_with('[')) return host.find(':') == std::string_view::npos ? std::optional(host) : std::nullopt;
  if (!host.ends_with(']') || host.find(':') == std::string_view::npos) return std::nullopt;
  return host.substr(1, host.size() - 2);
}

}  // namespace

std::optional<NetworkAddress> parse_network_address(std::string_view text) {
  for (const auto& [prefix, kind] : kKinds) {
    if (!text.starts_with(prefix)) continue;
    const std::string_view rest = text.substr(prefix.size());
    const std::size_t colon = rest.rfind(':');
    if (colon == std::string_view::npos) return std::nullopt;
    const auto host = without_brackets(rest.substr(0, colon));
    if (!host || !is_ip_address(*host)) return std::nullopt;
    const std::string_view digits = rest.substr(colon + 1);
    NetworkAddress address{kind, std::string(*host), 0};
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), address.port);
    if (error != std::errc{} || end != digits.data() + digits.size() || address.port == 0) return std::nullopt;
    return address;
  }
  return std::nullopt;
}

}  // namespace navcal::config
