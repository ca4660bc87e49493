// SPDX-License-Identifier: Apache-2.0
#include "config/network_address.h"

#include <gtest/gtest.h>

namespace navcal::config {
namespace {

using Way = NetworkAddress::Kind;

TEST(NetworkAddress, NamesKindHostAndPort) {
  EXPECT_EQ(parse_network_address("tcp:192.168.2.2:4001"), (NetworkAddress{Way::tcp, "192.168.2.2", 4001}));
  EXPECT_EQ(parse_network_address("tcp-listen:0.0.0.0:1"), (NetworkAddress{Way::tcp_listen, "0.0.0.0", 1}));
  EXPECT_EQ(parse_network_address("udp:localhost:65535"), (NetworkAddress{Way::udp, "localhost", 65535}));
}

TEST(NetworkAddress, AnIpv6AddressStandsInBrackets) {
  EXPECT_EQ(parse_network_address("udp:[::1]:4003"), (NetworkAddress{Way::udp, "::1", 4003}));
  EXPECT_EQ(parse_network_address("udp:::1:4003"), std::nullopt);
  EXPECT_EQ(parse_network_address("udp:[127.0.0.1]:4003"), std::nullopt);
}

TEST(NetworkAddress, AUnixSocketIsAnAbsolutePath) {
  EXPECT_EQ(parse_network_address("unix-listen:/run/navcal/samples"),
            (NetworkAddress{Way::unix_listen, "/run/navcal/samples", 0}));
  EXPECT_EQ(parse_network_address("unix-listen:samples"), std::nullopt);
  EXPECT_EQ(parse_network_address("unix-listen:"), std::nullopt);
  EXPECT_EQ(parse_network_address("unix-listen:/" + std::string(200, 'x')), std::nullopt);
}

TEST(NetworkAddress, RefusesWhatItCannotReach) {
  for (const char* const text :
       {"", "tcp", "tcp:", "tcp::", "tcp:127.0.0.1", "tcp:127.0.0.1:", "tcp:127.0.0.1:0", "tcp:127.0.0.1:65536",
        "tcp:127.0.0.1:-1", "tcp:127.0.0.1:80x", "tcp://127.0.0.1:80", "tcp:vehicle.local:80",
        "serial:127.0.0.1:80", "tcp:[]:80", "tcp:[:80", "tcp:]:80", "TCP:127.0.0.1:80", " tcp:127.0.0.1:80",
        "127.0.0.1:80"}) {
    EXPECT_EQ(parse_network_address(text), std::nullopt) << text;
  }
}

}  // namespace
}  // namespace navcal::config
