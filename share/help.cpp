// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "share/manual.h"

namespace navcal::share {

namespace {

/// The commands that a section names: "navcal log fetch, navcal log list". Those that this program lacks are left
/// out.
std::vector<CLI::App*> commands_named(CLI::App& app, const std::string& title) {
  std::vector<CLI::App*> found;
  std::istringstream paths(title);
  for (std::string path; std::getline(paths, path, ',');) {
    std::istringstream names(path);
    std::string name;
    names >> name;  // that of the program
    CLI::App* command = &app;
    while (command != nullptr && names >> name) {
      const auto below = command->get_subcommands([&](const CLI::App* one) { return one->check_name(name); });
      command = below.empty() ? nullptr : below.front();
    }
    if (command != nullptr) found.push_back(command);
  }
  return found;
}

std::string with_line_ends(std::string words) {
  for (std::size_t at = 0; (at = words.find("\\n", at)) != std::string::npos;) words.replace(at, 2, "\n");
  return words;
}

}  // namespace

void set_help(CLI::App& app, const char* texts) {
  std::vector<CLI::App*> commands;
  std::istringstream lines(texts);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("== ")) {
      commands = commands_named(app, line.substr(3));
    } else if (line.starts_with('@')) {
      const std::size_t space = std::min(line.find(' '), line.size() - 1);
      for (CLI::App* const command : commands) {
        CLI::Option* const option = command->get_option_no_throw(line.substr(1, space - 1));
        if (option != nullptr && option->get_description().empty())
          option->description(with_line_ends(line.substr(space + 1)));
      }
    } else {
      for (CLI::App* const command : commands)
        command->footer(command->get_footer() + (command->get_footer().empty() ? "" : "\n") + line);
    }
  }
}

}  // namespace navcal::share
