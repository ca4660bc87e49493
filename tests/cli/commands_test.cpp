// SPDX-License-Identifier: Apache-2.0
// Every subcommand is listed, says what it is for, and shows how it is used.
#include "cli/live/commands.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <regex>
#include <set>
#include <string>

#include "tests/support/temporary_folder.h"

namespace navcal::cli {
namespace {

using Visit = std::function<void(const CLI::App& command, const std::string& path)>;

void for_each_command(const CLI::App& app, const std::string& path, const Visit& visit) {
  // Names that no help lists are older ones of commands of navcal research.
  for (const CLI::App* command :
       app.get_subcommands([](const CLI::App* each) { return !each->get_group().empty(); })) {
    const std::string below = path + ' ' + command->get_name();
    visit(*command, below);
    for_each_command(*command, below, visit);
  }
}

TEST(Commands, EachHasADescriptionAndAnExampleOfItself) {
  CLI::App app("", "navcal");
  add_commands(app);
  int commands = 0;
  for_each_command(app, "navcal", [&](const CLI::App& command, const std::string& path) {
    ++commands;
    EXPECT_FALSE(command.get_description().empty()) << path;
    const std::string notes = command.get_footer();
    const std::size_t example = notes.find("Example");
    ASSERT_NE(example, std::string::npos) << path << ": no example";
    EXPECT_NE(notes.find(path, example), std::string::npos) << path << ": its example does not show it";
    for (const CLI::Option* option : command.get_options()) {
      EXPECT_FALSE(option->get_description().empty()) << path << ' ' << option->get_name();
    }
  });
  EXPECT_GT(commands, 12);
}

TEST(Commands, AreInSevenGroupsInTheOrderOfAUser) {
  CLI::App app("", "navcal");
  add_commands(app);
  const std::string help = app.help();
  std::size_t end = 0;
  for (const char* const group : {"\nLook:\n", "\nCalibrate:\n", "\nDiagnose:\n", "\nDrive:\n", "\nPractise:\n",
                                  "\nSet up:\n", "\nResearch:\n"}) {
    const std::size_t begin = help.find(group, end);
    ASSERT_NE(begin, std::string::npos) << group << help;
    end = begin + 1;
  }
  EXPECT_EQ(help.find("thesis\n"), std::string::npos) << help;
  EXPECT_EQ(help.find("validate-runs"), std::string::npos) << help;
  EXPECT_EQ(app.get_subcommand("gap")->help().find("\n  trial"), std::string::npos);
}

std::string options_of(const CLI::App& command) {
  std::string names;
  for (const CLI::Option* option : command.get_options()) names += option->get_name() + ' ';
  for (const CLI::App* below : command.get_subcommands(nullptr))
    names += below->get_name() + ": " + options_of(*below);
  return names;
}

// Scripts of outsiders use them.
TEST(Commands, OldNamesOfTheResearchCommandsStay) {
  CLI::App app("", "navcal");
  add_commands(app);
  const CLI::App& research = *app.get_subcommand("research");
  EXPECT_EQ(options_of(*app.get_subcommand("gap")->get_subcommand("trial")),
            options_of(*research.get_subcommand("gap-trial")));
  for (const char* const name : {"thesis", "validate-runs"})
    EXPECT_EQ(options_of(*app.get_subcommand(name)), options_of(*research.get_subcommand(name)));
}

// A file with a subcommand whose line in cli/live/commands.h was forgotten compiles, and nobody could call it.
TEST(Commands, EachSourceOfOneIsListed) {
  CLI::App app("", "navcal");
  add_commands(app);
  const std::regex definition("(^|\n)void add_([a-z_]+)\\(CLI::App& app\\) \\{");
  std::set<std::string> names;
  for (const CLI::App* command : app.get_subcommands(nullptr)) names.insert(command->get_name());
  std::size_t definitions = 0;
  for (const auto& file : std::filesystem::recursive_directory_iterator(NAVCAL_SOURCE_DIR "/cli")) {
    if (file.path().extension() != ".cpp") continue;
    const std::string text = navcal::test::read_file(file.path());
    for (auto it = std::sregex_iterator(text.begin(), text.end(), definition); it != std::sregex_iterator();
         ++it) {
      ++definitions;
      std::string name = (*it)[2].str();
      std::ranges::replace(name, '_', '-');
      EXPECT_EQ(names.count(name), 1U) << file.path();
    }
  }
  EXPECT_EQ(definitions, names.size());
}

}  // namespace
}  // namespace navcal::cli
