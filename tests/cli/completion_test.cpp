// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <fstream>

#include "tests/support/temporary_folder.h"

// Completions that a bash offers after it has read the script, requested as bash does.
namespace navcal::cli {
namespace {

class Completion : public testing::Test {
 protected:
  /// `typed`: the words before the cursor; the last may be begun or empty.
  [[nodiscard]] std::string offered(const std::string& typed, const std::string& shell = "bash") const {
    const auto script = folder_ / "script";
    std::ofstream(script) << "source <('" NAVCAL_PROGRAM "' completion " << shell << ")\n"
                          << "COMP_WORDS=(" << typed << ")\nCOMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n"
                          << "_navcal\necho \"${COMPREPLY[*]}\"\n";
    const std::string command = "cd " + folder_.path().string() + " && bash " + script.string() + " > out 2> err";
    const int status = std::system(command.c_str());
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << navcal::test::read_file(folder_ / "err");
    const std::string text = navcal::test::read_file(folder_ / "out");
    return text.substr(0, text.find('\n'));
  }

  navcal::test::TemporaryFolder folder_;
};

TEST_F(Completion, CommandsAndTheirCommands) {
  EXPECT_EQ(offered("navcal dec"), "decode");
  EXPECT_EQ(offered("navcal do"), "doctor");
  EXPECT_EQ(offered("navcal log ''"), "info finish export import surfacings list fetch start stop select");
  EXPECT_EQ(offered("navcal log ex"), "export");
  EXPECT_NE(offered("navcal ''").find("watch"), std::string::npos);
  EXPECT_EQ(offered("navcal thes"), "") << "listed by navcal research only";
  EXPECT_EQ(offered("navcal research ''"), "gap-trial validate-runs thesis");
  EXPECT_EQ(offered("navcal research gap-trial --cas"), "--cases");
}

TEST_F(Completion, OptionsOfTheCommandAndNoOther) {
  EXPECT_EQ(offered("navcal decode --js"), "--json");
  EXPECT_EQ(offered("navcal decode --proto"), "--protocol");
  EXPECT_EQ(offered("navcal gap trial --cas"), "--cases");
  EXPECT_EQ(offered("navcal gap --cas"), "");
  EXPECT_EQ(offered("navcal --vers"), "--version");
}

TEST_F(Completion, FilesWhereAValueOrAFileIsWanted) {
  std::ofstream(folder_ / "mission.cap") << "";
  EXPECT_EQ(offered("navcal replay miss"), "mission.cap");
  EXPECT_EQ(offered("navcal gap --report miss"), "mission.cap");
  EXPECT_EQ(offered("navcal gap --report x miss"), "mission.cap") << "after the value";
}

// Keys as a user presses them in a zsh on a terminal; the script is in a folder of completions, which is read when
// first needed.
TEST_F(Completion, ZshCompletesAtTheFirstTab) {
  if (std::system("command -v zsh > /dev/null") != 0) GTEST_SKIP() << "there is no zsh here";
  const auto path = folder_.path().string();
  ASSERT_EQ(std::system(("'" NAVCAL_PROGRAM "' completion zsh > '" + path + "/_navcal'").c_str()), 0);
  std::ofstream(folder_ / "ask") << R"(zmodload zsh/zpty
zpty z zsh -f -i
zpty -w z "PS1='REA''DY> '; fpath=($PWD \$fpath); autoload -U compinit; compinit -u -D; bindkey '^I' complete-word"
zpty -r z out '*READY> *'
zpty -w -n z $'navcal deco\t --proto\t'
zpty -r z out '*decode --protocol*'
print -r -- $out
)";
  ASSERT_EQ(std::system(("cd '" + path + "' && timeout 60 zsh -f ask > out 2> err").c_str()), 0)
      << navcal::test::read_file(folder_ / "err") << navcal::test::read_file(folder_ / "out");
  EXPECT_NE(navcal::test::read_file(folder_ / "out").find("decode --protocol"), std::string::npos)
      << navcal::test::read_file(folder_ / "out");
}

TEST_F(Completion, AShellThatIsNoneIsWrongUsage) {
  EXPECT_NE(std::system("'" NAVCAL_PROGRAM "' completion fish > /dev/null 2>&1"), 0);
}

}  // namespace
}  // namespace navcal::cli
