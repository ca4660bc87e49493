// SPDX-License-Identifier: Apache-2.0
// [vehicle] and port.NAME.serial_number: which vehicle and which single device this is.
#include <gtest/gtest.h>

#include "tests/config/expect_problems.h"

namespace navcal::config {
namespace {

Problems identity_problems(std::string_view table) {
  return problems_of(std::string("[vehicle]\n").append(table).append(kGoodPort));
}

TEST(ConfigIdentity, IsNotGivenByDefaultAndComesBack) {
  EXPECT_EQ(parse(kGoodPort, "t.toml").vehicle, IdentitySettings());
  const std::string text = std::string("[vehicle]\nid = \"AUV-2.b_9\"\nname = \"T\\u00FCmmler \\\"II\\\"\"\n") +
                           std::string(kGoodPort) + "serial_number = \"TCM2 40-113\"\n";
  const Settings settings = parse(text, "t.toml");
  EXPECT_EQ(settings.vehicle.id, "AUV-2.b_9");
  EXPECT_EQ(settings.vehicle.name, "Tümmler \"II\"");
  EXPECT_EQ(settings.ports.front().serial_number, "TCM2 40-113");
  EXPECT_EQ(parse(to_toml(settings), "again"), settings);
}

TEST(ConfigIdentity, IdsFitFileNamesAndNamesFitALine) {
  EXPECT_EQ(identity_problems("id = \"two words\"\n").size(), 1U);
  EXPECT_EQ(identity_problems("id = \"a/b\"\n").size(), 1U);
  EXPECT_EQ(identity_problems("id = \"" + std::string(65, 'a') + "\"\n").size(), 1U);
  EXPECT_EQ(identity_problems("id = \"" + std::string(64, 'a') + "\"\n"), Problems{});
  EXPECT_EQ(identity_problems("name = \"two\\nlines\"\n").size(), 1U);
  EXPECT_EQ(identity_problems("nick = \"x\"\n").size(), 1U);
}

TEST(ConfigIdentity, ADeviceIsAtOnePort) {
  const std::string two =
      "[port.a]\nprotocol = \"tcm2\"\npath = \"/dev/a\"\nserial_number = \"7\"\n"
      "[port.b]\nprotocol = \"tcm2\"\npath = \"/dev/b\"\nserial_number = \"7\"\n";
  EXPECT_EQ(problems_of(two), Problems{"t.toml:5: port.b.serial_number: 7 is already port.a's (line 1)"});
  const std::string of_two_makers =
      "[port.a]\nprotocol = \"tcm2\"\npath = \"/dev/a\"\nserial_number = \"7\"\n"
      "[port.b]\nprotocol = \"oncore\"\npath = \"/dev/b\"\nserial_number = \"7\"\n";
  EXPECT_EQ(problems_of(of_two_makers), Problems{});
}

}  // namespace
}  // namespace navcal::config
