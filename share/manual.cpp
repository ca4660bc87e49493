// SPDX-License-Identifier: Apache-2.0
#include "share/manual.h"

#include <cstdio>
#include <sstream>
#include <string_view>

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

/// What stands below a command's options: prose, and lines to be kept as they are, which are indented or follow
/// "Example:".
std::string notes(const std::string& footer) {
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

std::string synopsis(const CLI::App& app, const std::string& path) {
  std::string out = path;
  if (!app.get_subcommands(nullptr).empty()) out += " COMMAND";
  out += " [OPTION]...";
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_positional()) out += ' ' + CLI::Formatter().make_option_usage(option);
  }
  return out;
}

void append_command(std::string& out, const CLI::App& app, const std::string& path) {
  out += "### " + plain(path) + "\n\n" + plain(app.get_description()) + "\n\n    " + synopsis(app, path) + "\n\n";
  append_options(out, app);
  out += notes(app.get_footer()) + '\n';
  for (const CLI::App* command : app.get_subcommands(nullptr)) {
    append_command(out, *command, path + ' ' + command->get_name());
  }
}

}  // namespace

std::string manual(const CLI::App& app) {
  const std::string name = app.get_name();
  std::string out = "# " + name + "\n\n" + plain(app.get_description()) + "\n\n## SYNOPSIS\n\n    " +
                    synopsis(app, name) + "\n\n## OPTIONS\n\n";
  append_options(out, app);
  out += notes(app.get_footer()) + '\n';
  const auto commands = app.get_subcommands(nullptr);
  if (!commands.empty()) out += "## COMMANDS\n\n";
  for (const CLI::App* command : commands) append_command(out, *command, name + ' ' + command->get_name());
  return out;
}

void add_manual(CLI::App& app) {
  app.add_flag_callback(
      "--manual",
      [&app] {
        std::fputs(manual(app).c_str(), stdout);
        throw CLI::Success();
      },
      "Print the text of the manual page, as Markdown, and exit");
}

}  // namespace navcal::share
