// SPDX-License-Identifier: Apache-2.0
#include "web/access.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>

#include "tests/support/temporary_folder.h"

namespace navcal::web {
namespace {

const std::string kToken = "0123456789abcdef0123";

TEST(Access, OnlyTheWholeTokenMayChange) {
  const Access access(kToken);
  EXPECT_FALSE(access.refusal("Bearer " + kToken));
  EXPECT_FALSE(access.refusal("bearer " + kToken));
  for (const std::string& wrong :
       {std::string(), std::string("Bearer "), kToken, "Bearer " + kToken.substr(1), "Bearer " + kToken + "x",
        "Bearer " + kToken + kToken, "Basic " + kToken, "Bearer " + std::string(kToken.size(), '\0')}) {
    EXPECT_TRUE(access.refusal(wrong)) << wrong;
  }
}

TEST(Access, WithoutATokenNobodyMayChange) {
  const Access access;
  EXPECT_TRUE(access.refusal("Bearer "));
  EXPECT_TRUE(access.refusal(""));
  EXPECT_FALSE(access.can_change());
}

TEST(Access, NamesThatAnotherSiteCanPointHereAreNotKnown) {
  const Access access("", {"auv.example.org"});
  for (const char* known : {"127.0.0.1", "127.0.0.1:8765", "[::1]:8765", "192.168.2.2", "localhost:8765",
                            "vehicle", "BlueOS.local", "auv.example.org:80", "AUV.EXAMPLE.ORG"})
    EXPECT_TRUE(access.knows_host(known)) << known;
  for (const char* unknown :
       {"", "evil.example", "auv.example.org.evil.example", ".local", "127.0.0.1.evil.example"})
    EXPECT_FALSE(access.knows_host(unknown)) << unknown;
}

TEST(Access, OriginOfAnotherSiteIsTold) {
  const Access access("", {}, {"https://panel.example"});
  EXPECT_TRUE(access.knows_origin("", "vehicle:8765")) << "no browser";
  EXPECT_TRUE(access.knows_origin("http://vehicle:8765", "vehicle:8765"));
  EXPECT_TRUE(access.knows_origin("https://Vehicle:8765", "vehicle:8765"));
  EXPECT_FALSE(access.knows_origin("http://vehicle:80", "vehicle:8765"));
  EXPECT_FALSE(access.knows_origin("null", "vehicle:8765"));
  EXPECT_FALSE(access.knows_origin("http://evil.example", "vehicle:8765"));
  EXPECT_TRUE(access.knows_origin("https://panel.example", "vehicle:8765"));
  EXPECT_FALSE(access.knows_origin("http://panel.example", "vehicle:8765"));
}

TEST(Access, OnlyThisComputerByANameOfItsOwnIsFromHere) {
  EXPECT_TRUE(is_from_here("127.0.0.1", "localhost:8765", ""));
  EXPECT_TRUE(is_from_here("127.0.0.1", "127.0.0.1:8765", "http://127.0.0.1:8765"));
  EXPECT_TRUE(is_from_here("::1", "[::1]:8765", "http://[::1]:8765"));
  EXPECT_TRUE(is_from_here("::ffff:127.0.0.1", "localhost", "http://localhost"));
  EXPECT_FALSE(is_from_here("192.168.2.1", "localhost:8765", "")) << "another computer";
  EXPECT_FALSE(is_from_here("::ffff:192.168.2.1", "localhost:8765", ""));
  EXPECT_FALSE(is_from_here("127.0.0.1", "vehicle.local:8765", "http://vehicle.local:8765")) << "a proxy";
  EXPECT_FALSE(is_from_here("127.0.0.1", "127.0.0.1:8765", "https://vehicle.example")) << "a proxy with our name";
  EXPECT_FALSE(is_from_here("127.0.0.1", "127.0.0.1:8765", "null"));
  EXPECT_FALSE(is_from_here("127.0.0.1", "", ""));
}

TEST(TokenFile, ProblemsAreNamedWithTheFile) {
  const navcal::test::TemporaryFolder folder;
  const auto file = folder.path() / "token";
  const auto problem = [&] {
    try {
      return read_token(file);
    } catch (const std::runtime_error& error) {
      EXPECT_NE(std::string(error.what()).find(file.string()), std::string::npos) << error.what();
      return std::string(error.what());
    }
  };
  EXPECT_NE(problem().find("No such file"), std::string::npos);
  std::ofstream(file) << "short\n";
  ::chmod(file.c_str(), 0640);
  EXPECT_NE(problem().find("5 characters"), std::string::npos);
  std::ofstream(file) << "  " << kToken << " \r\nsecond line\n";
  EXPECT_EQ(problem(), kToken);
  ::chmod(file.c_str(), 0644);
  EXPECT_NE(problem().find("chmod"), std::string::npos);
}

}  // namespace
}  // namespace navcal::web
