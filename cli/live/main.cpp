// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cstdio>
#include <exception>

#include "base/printable.h"
#include "cli/live/commands.h"
#include "cli/live/exit_statuses.h"
#include "config/complaints.h"
#include "share/manual.h"

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

/// Message for a command line with a command or an option that does not exist: its name and the nearest one
/// that does. Empty when neither is the cause of the error.
std::string misspelling(const CLI::App& app, const std::vector<std::string>& arguments) {
  const CLI::App* current = &app;
  std::string called = app.get_name();
  for (const std::string& argument : arguments) {
    if (argument.starts_with("--")) {
      const std::string name = argument.substr(0, argument.find('='));
      if (name == "--" || current->get_option_no_throw(name) != nullptr) continue;
      return fmt::format("{}: there is no option {}{} ({} --help)", called, name,
                         navcal::config::suggestion(name, option_names(*current)), called);
    }
    if (argument.starts_with('-')) continue;
    if (const CLI::App* const command = command_named(*current, argument)) {
      current = command;
      called += ' ' + command->get_name();
    } else if (current->get_require_subcommand_min() > 0) {
      return fmt::format("{}: there is no command {}{} ({} --help)", called, argument,
                         navcal::config::suggestion(argument, command_names(*current)), called);
    }
  }
  return {};
}

/// True when the last command of the line is one of a group and names no command in it.
bool lacks_command(const CLI::App& app, const CLI::ParseError& error) {
  const CLI::App* called = &app;
  while (!called->get_subcommands().empty()) called = called->get_subcommands().back();
  return error.get_name() == "RequiredError" && called->get_require_subcommand_min() > 0;
}

}  // namespace

int main(int argc, char** argv) {
  using navcal::base::Exit;
  CLI::App app{
      "navcal: reads, calibrates, records and simulates the instruments of a small underwater vehicle, and names "
      "the cause\nwhere it departs from its model",
      "navcal"};
  app.set_version_flag("--version", "navcal " NAVCAL_VERSION);
  app.require_subcommand(1);

  navcal::cli::add_commands(app);
  navcal::share::add_manual(app);

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (const std::string words = misspelling(app, {argv + 1, argv + argc}); !words.empty()) {
      std::fprintf(stderr, "%s\n", words.c_str());
      return static_cast<int>(Exit::usage);
    }
    if (lacks_command(app, error)) {
      std::fputs(app.help().c_str(), stderr);
      return static_cast<int>(Exit::usage);
    }
    // CLI11 has statuses of its own; the contract has one for wrong usage.
    return app.exit(error) == 0 ? static_cast<int>(Exit::success) : static_cast<int>(Exit::usage);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "navcal: %s\n", navcal::base::printable(error).c_str());
    return static_cast<int>(navcal::cli::exit_status_of(error));
  }
  return static_cast<int>(Exit::success);
}
