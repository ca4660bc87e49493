// SPDX-License-Identifier: Apache-2.0
// Files that are hostile, broken or not there.
#include <fmt/format.h>

#include <filesystem>
#include <fstream>

#include "tests/config/expect_problems.h"

namespace navcal::config {
namespace {

std::string repeated(std::string_view piece, std::size_t times) {
  std::string out;
  for (std::size_t i = 0; i < times; ++i) out += piece;
  return out;
}

TEST(ConfigDocuments, ASyntaxErrorHasItsLine) {
  const auto problems = problems_of("[log]\nenabled = true\nsync_interval_s = = 3\n");
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_TRUE(problems[0].starts_with("t.toml:3: ")) << problems[0];
}

TEST(ConfigDocuments, NotUtf8) { EXPECT_EQ(problems_of("[log]\ndirectory = \"/\xff\"\n").size(), 1U); }

TEST(ConfigDocuments, CutAnywhereIsAnErrorOrAConfiguration) {
  const std::string whole =
      std::string(kGoodPort) +
      "[log]\nenabled = true\nrotate_MB = 3.5 # a comment\n[port.gps.fix]\nrollover_pivot = \"2019-04-07\"\n";
  EXPECT_EQ(problems_of(whole), Problems{});
  for (std::size_t length = 0; length < whole.size(); ++length) {
    for (const auto& problem : problems_of(std::string_view(whole).substr(0, length))) {
      EXPECT_TRUE(problem.starts_with("t.toml:")) << problem;
    }
  }
}

TEST(ConfigDocuments, DeepNestingIsRefusedNotFollowed) {
  EXPECT_EQ(problems_of("a = " + repeated("[", 100000)).size(), 1U);
  EXPECT_EQ(problems_of("a = " + repeated("{a=", 60000)).size(), 1U);
  EXPECT_EQ(problems_of(repeated("a.", 100000) + "a = 1\n"), Problems{"t.toml:1: the line has more than 32 dots"});
  EXPECT_EQ(problems_of("[" + repeated("a.", 100000) + "a]\n"),
            Problems{"t.toml:1: the line has more than 32 dots"});
  EXPECT_EQ(problems_of("x = 1\n" + repeated("\"a\" .", 100) + "a = 1\n"),
            Problems{"t.toml:2: the line has more than 32 dots"});
}

TEST(ConfigDocuments, TheDeepestNestingThatIsFollowedIsSurvived) {
  // Dotted keys within nested values over many lines: the worst that the bounds leave possible.
  const std::string level = repeated("a.", 32) + "a = [\n{";
  EXPECT_GE(problems_of(repeated(level, 120) + repeated("}]", 120)).size(), 1U);
  EXPECT_GE(problems_of(repeated(level, 3000)).size(), 1U);
  EXPECT_GE(problems_of("[" + repeated("a.", 31) + "a]\n" + repeated("a.", 31) + "a = 1\n").size(), 1U);
}

TEST(ConfigDocuments, ABracketWithoutANameIsRefused) {
  for (const std::string bad :
       {"[\x02"
        "4\x02",
        "[=]", "  [ !a]", "[[ .a]]", "[[\t#]]", "[{]", "[", "[ [a]]", "[[[", "[\ra]", "[ \t"}) {
    EXPECT_EQ(problems_of("x = 1\n" + bad + "\n"), Problems{"t.toml:2: a name is missing behind the bracket"})
        << bad;
  }
  for (const std::string told_by_the_parser : {"[]", "[ ]", "[[]]"}) {
    EXPECT_GE(problems_of(told_by_the_parser).size(), 1U) << told_by_the_parser;
  }
}

TEST(ConfigDocuments, AnEndlessFileIsRefused) {
  EXPECT_EQ(problems_of(repeated("# comment\n", 30000)),
            Problems{"t.toml:1: the file has more than 262144 bytes"});
}

TEST(ConfigDocuments, BeyondAsciiOnlyInCommentsAndAsEscapes) {
  const auto directory = [](std::string_view text) {
    return problems_beside_a_port(fmt::format("[log]\ndirectory = {} # \u00e9\n", text));
  };
  EXPECT_EQ(directory("\"/d\\u00e9p\\u00f4t\""), Problems{});
  EXPECT_EQ(parse(std::string(kGoodPort) + "[log]\ndirectory = \"/d\\u00e9p\\u00f4t\"\n", "t.toml").log.directory,
            "/d\u00e9p\u00f4t");
  const Problems refused{"t.toml:7: a character beyond ASCII; in quotes it can be written as \\u00E9"};
  for (const std::string text :
       {"\"/\u00e9\"", "\"\u01c7\"", "'/\u00e9'", "\u0343", "\"/a\\\"\" \u0343", "\"/a\\\\\"\u0343"}) {
    EXPECT_EQ(directory(text), refused) << text;
  }
}

TEST(ConfigDocuments, AByteOrderMarkIsNoCharacter) {
  EXPECT_EQ(problems_of(std::string("\xef\xbb\xbf").append(kGoodPort)), Problems{});
}

TEST(ConfigDocuments, TextsOverSeveralLinesAreRefused) {
  for (const std::string quotes : {"\"\"\"", "'''"}) {
    EXPECT_EQ(problems_beside_a_port("[log]\ndirectory = " + quotes + "/a\\\n\u00a7" + quotes + "\n"),
              Problems{"t.toml:7: a text over several lines is not taken"});
  }
}

TEST(ConfigDocuments, CommentsMayHaveDots) {
  EXPECT_EQ(problems_beside_a_port("  # " + repeated(".", 100) + "\n[log] # " + repeated(".", 100)), Problems{});
}

TEST(ConfigDocuments, LinesMayEndInCrLf) {
  EXPECT_EQ(problems_of("[port.gps]\r\nprotocol = \"oncore\"\r\npath = \"/dev/ttyS0\"\r\n"), Problems{});
}

TEST(ConfigDocuments, InlineTablesAndDottedKeysAreTheSame) {
  const auto plain = parse(kGoodPort, "t.toml");
  EXPECT_EQ(parse("port.gps = {protocol = \"oncore\", path = \"/dev/ttyS0\"}", "t.toml"), plain);
  EXPECT_EQ(parse("port.gps.path = \"/dev/ttyS0\"\nport.gps.protocol = \"oncore\"\n", "t.toml"), plain);
}

TEST(ConfigDocuments, AFileThatCannotBeRead) {
  const auto message = [](const std::filesystem::path& file) -> std::string {
    try {
      static_cast<void>(load(file));
      return "accepted";
    } catch (const Error& error) {
      return error.what();
    }
  };
  EXPECT_EQ(message("/nonexistent/navcald.toml"),
            "/nonexistent/navcald.toml: cannot be read: No such file or directory");
  EXPECT_EQ(message("/tmp"), "/tmp: cannot be read: Is a directory");
}

TEST(ConfigDocuments, LoadReadsWhatParseReads) {
  const auto file = std::filesystem::path(testing::TempDir()) / "navcal_test_config.toml";
  std::ofstream(file) << kGoodPort;
  EXPECT_EQ(load(file, {"status.port=3"}), parse(kGoodPort, "x", {"status.port=3"}));
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace navcal::config
