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
  const Key key = Key::from_text("a secret of some length");
  const Key other = Key::from_text("a secret of some other length");
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
    return Key::from_text(text).outside().tag(Direction::to_vehicle, {});
  };
  EXPECT_EQ(tag_of(digits), tag_of("  " + digits + "\n"));
  std::string lower = digits;
  for (char& c : lower) c = static_cast<char>(std::tolower(c));
  EXPECT_EQ(tag_of(digits), tag_of(lower));
  EXPECT_NE(tag_of("sixteen letters."), tag_of("Sixteen letters."));
  EXPECT_THROW(static_cast<void>(Key::from_text(" \n")), std::runtime_error);
  EXPECT_THROW(static_cast<void>(Key::from_text("too short")), std::runtime_error);
  EXPECT_THROW(static_cast<void>(Key::from_text(std::string(5000, 'a'))), std::runtime_error);
}

TEST(LinkKey, AFileThatOthersCanReadIsRefused) {
  const test::TemporaryFolder folder;
  const auto file = folder.path() / "key";
  std::ofstream(file) << "sixteen letters.\n";
  ::chmod(file.c_str(), 0600);
  EXPECT_NO_THROW(static_cast<void>(Key::from_file(file)));
  for (const mode_t mode : {0640U, 0604U, 0620U, 0601U}) {
    ::chmod(file.c_str(), mode);
    try {
      static_cast<void>(Key::from_file(file));
      ADD_FAILURE() << mode;
    } catch (const std::runtime_error& error) {
      EXPECT_NE(std::string(error.what()).find("chmod 600"), std::string::npos);
    }
  }
  EXPECT_THROW(static_cast<void>(Key::from_file(folder.path() / "none")), std::runtime_error);
  EXPECT_THROW(static_cast<void>(Key::from_file(folder.path())), std::runtime_error);
}

}  // namespace
}  // namespace navcal::link
