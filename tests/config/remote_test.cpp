// SPDX-License-Identifier: Apache-2.0
// [remote]: the line of the remote link.
#include <gtest/gtest.h>

#include "config/load.h"
#include "config/network_address.h"
#include "tests/config/expect_problems.h"

namespace navcal::config {
namespace {

Problems remote_problems(std::string_view remote) {
  return problems_of(std::string("[remote]\n").append(remote).append(kGoodPort), {});
}

TEST(ConfigRemote, IsOffUnlessALineIsGivenAndComesBack) {
  EXPECT_FALSE(Settings().remote.enabled());
  const Settings settings =
      parse(std::string("[remote]\nlisten = \"[::1]:2950\"\non_dead = \"safe\"\ndead_s = 3\n").append(kGoodPort),
            "t.toml", {});
  EXPECT_TRUE(settings.remote.enabled());
  EXPECT_EQ(settings.remote.on_dead, OnDead::safe);
  EXPECT_EQ(settings.remote.baud, 57600);
  EXPECT_EQ(parse(to_toml(settings), "again", {}), settings);
}

TEST(ConfigRemote, HasOneLine) {
  EXPECT_EQ(remote_problems("path = \"/dev/ttyUSB0\"\nlisten = \"127.0.0.1:1\"\n"),
            Problems{"t.toml:3: remote.listen: path and listen are given: the link has one line"});
  EXPECT_EQ(remote_problems("path = \"ttyUSB0\"\n").size(), 1U);
  EXPECT_EQ(remote_problems("key_file = \"key\"\n").size(), 1U);
  EXPECT_EQ(remote_problems("on_dead = \"surface\"\n").size(), 1U);
}

TEST(ConfigRemote, AddressesHaveAPort) {
  EXPECT_EQ(socket_address("127.0.0.1:2950")->port, 2950);
  EXPECT_EQ(socket_address("[::1]:0")->address, "::1");
  EXPECT_EQ(socket_address("localhost:1")->address, "localhost");
  for (const std::string_view bad : {"", "2950", "127.0.0.1", "127.0.0.1:", "127.0.0.1:x", "127.0.0.1:65536",
                                     "::1:2950", "example.org:1", ":1"})
    EXPECT_FALSE(socket_address(bad)) << bad;
}

}  // namespace
}  // namespace navcal::config
