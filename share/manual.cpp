// SPDX-License-Identifier: Apache-2.0
#include "share/manual.h"

#include <cstdio>
#include <sstream>
#include <string_view>
#include <utility>

namespace navcal::share {
namespace {

/// Around lines that are kept as they are. (Indented ones would count to the list before them.)
constexpr const char* kFence = "```\n";

/// Words that mean nothing to Markdown.
std::string plain(std::string_view words) {
  std::string out;
  for (const char c : words) {
    if (std::string_view("\\`*_{}[]<>#|").find(c) != std::string_view::npos) out += '\\';
    out += c;
  }
  return out;
}

/// The text below a command's options: prose, and lines to be kept as they are, which are indented or follow
/// "Example:". `heading` stands before the examples.
std::string notes(const std::string& footer, std::string_view heading = "") {
  std::istringstream lines(footer);
  std::string out, line;
  bool verbatim = false;
  const auto keep = [&](bool as_it_is, const std::string& text) {
    if (as_it_is != verbatim) out += kFence;
    verbatim = as_it_is;
    out += (as_it_is ? text : plain(text)) + '\n';
  };
  while (std::getline(lines, line)) {
    const std::size_t colon = line.starts_with("Example") ? line.find(':') : std::string::npos;
    const std::size_t indented = line.find_first_not_of(' ');
    if (colon != std::string::npos) {
      if (!heading.empty()) {
        keep(false, "");
        out += std::exchange(heading, {});
      }
      if (const auto text = line.find_first_not_of(' ', colon + 1); text != std::string::npos)
        keep(true, line.substr(text));
    } else {
      const bool as_it_is = indented != std::string::npos && indented > 0;
      keep(as_it_is, as_it_is ? line.substr(indented) : line);
    }
  }
  if (verbatim) out += kFence;
  return out;
}

void append_options(std::string& out, const CLI::App& app) {
  const CLI::Formatter formatter;
  for (const CLI::Option* option : app.get_options()) {
    const bool is_help = option == app.get_help_ptr() && app.get_parent() != nullptr;  // every command has it
    if (is_help || option->get_group().empty()) continue;
    const bool positional = option->get_positional();
    out += "**" + plain(formatter.make_option_name(option, positional)) + "**" +
           plain(formatter.make_option_opts(option)) + "\n: " + plain(formatter.make_option_desc(option)) + "\n\n";
  }
}

std::string path_of(const CLI::App& app) {
  return app.get_parent() == nullptr ? app.get_name() : path_of(*app.get_parent()) + ' ' + app.get_name();
}

std::vector<const CLI::App*> listed_commands(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App* command) { return !command->get_group().empty(); });
}

std::string synopsis(const CLI::App& app) {
  std::string out = path_of(app);
  if (!listed_commands(app).empty()) out += " COMMAND";
  out += " [OPTION]...";
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_positional()) out += ' ' + CLI::Formatter().make_option_usage(option);
  }
  return out;
}

void append_command(std::string& out, const CLI::App& app) {
  out +=
      "### " + plain(path_of(app)) + "\n\n" + plain(app.get_description()) + "\n\n    " + synopsis(app) + "\n\n";
  append_options(out, app);
  out += notes(app.get_footer()) + '\n';
  for (const CLI::App* command : listed_commands(app)) append_command(out, *command);
}

/// The commands that have pages of their own, in their groups.
void append_pages(std::string& out, const CLI::App& app) {
  std::string group;
  for (const CLI::App* command : listed_commands(app)) {
    if (command->get_group() != group) out += "### " + plain(group = command->get_group()) + "\n\n";
    out += "**" + app.get_name() + '-' + command->get_name() + "**(1)\n: " + plain(command->get_description()) +
           "\n\n";
  }
}

}  // namespace

std::string manual(const CLI::App& app) {
  std::string out = "# " + path_of(app) + "\n\n" + plain(app.get_description()) + "\n\n## SYNOPSIS\n\n    " +
                    synopsis(app) + "\n\n## OPTIONS\n\n";
  append_options(out, app);
  const bool is_program = app.get_parent() == nullptr;
  out += notes(app.get_footer(), is_program ? "" : "\n## EXAMPLES\n\n") + '\n';
  const auto commands = listed_commands(app);
  if (!commands.empty()) out += "## COMMANDS\n\n";
  if (is_program) append_pages(out, app);
  for (const CLI::App* command : commands) {
    if (!is_program) append_command(out, *command);
  }
  return out;
}

void add_manual(CLI::App& app) {
  auto* const flag = app.add_flag_callback(
      "--manual",
      [&app] {
        std::fputs(manual(app).c_str(), stdout);
        throw CLI::Success();
      },
      "Print the text of the manual page, as Markdown, and exit");
  if (app.get_parent() != nullptr) flag->group("");
  for (const CLI::App* command : listed_commands(app)) add_manual(*app.get_subcommand(command->get_name()));
}

int run_program(CLI::App& app, int argc, char** argv, const std::function<void()>& run,
                const std::function<void()>& check) {
  enum Exit : int { kStopped = 0, kCannotStart = 1, kUsage = 2 };
  add_manual(app);
  try {
    app.parse(argc, argv);
    check();
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kStopped : kUsage;
  }
  try {
    run();
    return kStopped;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: cannot start: %s\n", app.get_name().c_str(), error.what());
    return kCannotStart;
  }
}

}  // namespace navcal::share
