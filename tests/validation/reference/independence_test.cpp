// SPDX-License-Identifier: Apache-2.0
// Written twice on purpose: this reality shares no model with the simulator, and the diagnosis cannot reach it.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <regex>
#include <set>
#include <sstream>
#include <string>

namespace navcal::reference::testing {
namespace {

namespace fs = std::filesystem;

std::set<std::string> quoted_includes(const fs::path& room) {
  static const std::regex kInclude("^\\s*#\\s*include\\s*\"([^\"]+)\"");
  std::set<std::string> includes;
  for (const auto& entry : fs::recursive_directory_iterator(room)) {
    if (entry.path().extension() != ".h" && entry.path().extension() != ".cpp") continue;
    std::ifstream file(entry.path());
    std::smatch match;
    for (std::string line; std::getline(file, line);) {
      if (std::regex_search(line, match, kInclude)) includes.insert(match[1]);
    }
  }
  return includes;
}

/// "target: everything that it links, directly or not", a line each, as CMake knows them.
std::optional<std::set<std::string>> linked_by(const std::string& target) {
  std::ifstream file(NAVCAL_LINKS_FILE);
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with(target + ":")) continue;
    std::istringstream names(line.substr(target.size() + 1));
    return std::set<std::string>(std::istream_iterator<std::string>(names), {});
  }
  return std::nullopt;
}

TEST(Independence, TheReferenceIncludesNothingButProtocols) {
  const auto includes = quoted_includes(NAVCAL_SOURCE_DIR "/validation/reference");
  EXPECT_FALSE(includes.empty());
  for (const std::string& include : includes)
    EXPECT_TRUE(include.starts_with("validation/reference/") || include.starts_with("protocols/")) << include;
}

TEST(Independence, TheReferenceLinksNothingButProtocolsAndLibraries) {
  const auto linked = linked_by("navcal_validation_reference");
  ASSERT_TRUE(linked);
  // The protocols bring the headers of what samples are, which have no code.
  for (const std::string& name : *linked)
    EXPECT_TRUE(!name.starts_with("navcal") || name == "navcal_protocols" || name == "navcal_api_include") << name;
  EXPECT_TRUE(linked->contains("navcal_protocols"));
}

class Stranger : public ::testing::TestWithParam<const char*> {};

TEST_P(Stranger, HasNothingOfTheReference) {
  const std::string room = GetParam();
  // A room that was renamed would pass without being looked at.
  const auto includes = quoted_includes(NAVCAL_SOURCE_DIR "/" + room);
  ASSERT_FALSE(includes.empty()) << room;
  for (const std::string& include : includes)
    EXPECT_FALSE(include.starts_with("validation/reference/")) << include;
  const auto linked = linked_by("navcal_" + room);
  ASSERT_TRUE(linked) << "CMake knows no navcal_" << room;
  EXPECT_FALSE(linked->contains("navcal_validation_reference"));
}

INSTANTIATE_TEST_SUITE_P(Rooms, Stranger,
                         ::testing::Values("sim", "gap", "nav", "calib", "pipeline", "instruments", "protocols"));

}  // namespace
}  // namespace navcal::reference::testing
