// SPDX-License-Identifier: Apache-2.0
#include "cli/misspelling.h"

#include <fmt/format.h>

#include "config/suggestion.h"

namespace navcal::cli {
namespace {

const CLI::App* command_named(const CLI::App& app, const std::string& name) {
  for (const CLI::App* const command : app.get_subcommands([](const CLI::App*) { return true; })) {
    if (command->check_name(name)) return command;
  }
  return nullptr;
}

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* const command : app.get_subcommands([](const CLI::App*) { return true; })) {
    names.push_back(command->get_name());
  }
  return names;
}

std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* const option : app.get_options([](const CLI::Option*) { return true; })) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

}  // namespace

std::string misspelling(const CLI::App& app, const std::vector<std::string>& arguments) {
  const CLI::App* current = &app;
  std::string called = app.get_name();
  for (const std::string& argument : arguments) {
    if (argument.starts_with("--")) {
      const std::string name = argument.substr(0, argument.find('='));
      if (name == "--" || current->get_option_no_throw(name) != nullptr) continue;
      return fmt::format("{}: there is no option {}{} ({} --help)", called, name,
                         config::suggestion(name, option_names(*current)), called);
    }
    if (argument.starts_with('-')) continue;
    if (const CLI::App* const command = command_named(*current, argument)) {
      current = command;
      called += ' ' + command->get_name();
    } else if (current->get_require_subcommand_min() > 0) {
      return fmt::format("{}: there is no command {}{} ({} --help)", called, argument,
                         config::suggestion(argument, command_names(*current)), called);
    }
  }
  return {};
}

}  // namespace navcal::cli
