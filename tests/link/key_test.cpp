// SPDX-License-Identifier: Apache-2.0
#include "link/key.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cctype>
#include <fstream>

#include "tests/support/temporary_folder.h"

namespace navcal::link {
namespace {

TEST(LinkKey, TagsFitOnlyTheirKeySessionDirectionAndBytes) {
  const Key key = std::get<Key>(Key::from_text("a secret of some length"));
  const Key other = std::get<Key>(Key::from_text("a secret of some other length"));
  const Nonce vehicle{1, 2, 3}, host{4, 5, 6};
  const Buffer bytes{10, 20, 30};
  const Tag tag = key.session(vehicle, host).tag(Direction::to_vehicle, bytes);
  const auto verifies = [&](const SessionKey& session, Direction direction, Bytes covered) {
    return session.verifies(direction, covered, tag);
  };
  EXPECT_TRUE(verifies(key.session(vehicle, host), Direction::to_vehicle, bytes));
  EXPECT_FALSE(verifies(other.session(vehicle, host), Direction::to_vehicle, bytes));
  EXPECT_FALSE(verifies(key.session({9}, host), Direction::to_vehicle, bytes));
  EXPECT_FALSE(verifies(key.session(vehicle, {9}), Direction::to_vehicle, bytes));
  EXPECT_FALSE(verifies(key.outside(), Direction::to_vehicle, bytes));
  EXPECT_FALSE(verifies(key.session(vehicle, host), Direction::to_operator, bytes));
  EXPECT_FALSE(verifies(key.session(vehicle, host), Direction::to_vehicle, Bytes(bytes).first(2)));
  EXPECT_FALSE(key.session(vehicle, host).verifies(Direction::to_vehicle, bytes, Bytes(tag).first(7)));
}

TEST(LinkKey, IsHexadecimalOrText) {
  const std::string digits = "00112233445566778899aabbccddeeff00112233445566778899AABBCCDDEEFF";
  const auto tag_of = [](std::string_view text) {
    return std::get<Key>(Key::from_text(text)).outside().tag(Direction::to_vehicle, {});
  };
  EXPECT_EQ(tag_of(digits), tag_of("  " + digits + "\n"));
  std::string lower = digits;
  for (char& c : lower) c = static_cast<char>(std::tolower(c));
  EXPECT_EQ(tag_of(digits), tag_of(lower));
  EXPECT_NE(tag_of("sixteen letters."), tag_of("Sixteen letters."));
  EXPECT_TRUE(std::holds_alternative<std::string>(Key::from_text(" \n")));
  EXPECT_TRUE(std::holds_alternative<std::string>(Key::from_text("too short")));
  EXPECT_TRUE(std::holds_alternative<std::string>(Key::from_text(std::string(5000, 'a'))));
}

TEST(LinkKey, AFileThatOthersCanReadIsRefused) {
  const test::TemporaryFolder folder;
  const auto file = folder.path() / "key";
  std::ofstream(file) << "sixteen letters.\n";
  ::chmod(file.c_str(), 0600);
  EXPECT_TRUE(std::holds_alternative<Key>(Key::from_file(file)));
  for (const mode_t mode : {0640U, 0604U, 0620U, 0601U}) {
    ::chmod(file.c_str(), mode);
    const auto refused = Key::from_file(file);
    ASSERT_TRUE(std::holds_alternative<std::string>(refused)) << mode;
    EXPECT_NE(std::get<std::string>(refused).find("chmod 600"), std::string::npos);
  }
  EXPECT_TRUE(std::holds_alternative<std::string>(Key::from_file(folder.path() / "none")));
  EXPECT_TRUE(std::holds_alternative<std::string>(Key::from_file(folder.path())));
}

}  // namespace
}  // namespace navcal::link
