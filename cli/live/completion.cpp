// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>

#include "cli/live/commands.h"

namespace navcal::cli {
namespace {

/// Names of what may come next, blank after each.
struct Words {
  std::string commands;  ///< subcommands
  std::string options;
  std::string with_value;  ///< those of the options that take one
};

Words words_of(const CLI::App& app) {
  Words words;
  for (const CLI::App* command : app.get_subcommands(nullptr)) {
    if (!command->get_group().empty()) words.commands += command->get_name() + ' ';
  }
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_group().empty()) continue;  // not for people
    for (const auto& name : option->get_lnames()) {
      words.options += "--" + name + ' ';
      if (option->get_items_expected_max() > 0) words.with_value += "--" + name + ' ';
    }
    for (const auto& name : option->get_snames()) {
      words.options += '-' + name + ' ';
      if (option->get_items_expected_max() > 0) words.with_value += '-' + name + ' ';
    }
  }
  return words;
}

/// One branch for each command, known by its path ("", "log", "log info"), and those below it.
void append_branches(std::string& out, const CLI::App& app, const std::string& path) {
  const Words words = words_of(app);
  out += fmt::format("    '{}') commands='{}' options='{}' with_value='{}' ;;\n", path, words.commands,
                     words.options, words.with_value);
  for (const CLI::App* command : app.get_subcommands(nullptr)) {
    append_branches(out, *command, path.empty() ? command->get_name() : path + ' ' + command->get_name());
  }
}

std::string script_of(const CLI::App& app) {
  std::string branches;
  append_branches(branches, app, "");
  return "_navcal_words() {\n  case \"$1\" in\n" + branches + R"(    *) return 1 ;;
  esac
}
_navcal() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} command= i
  local commands options with_value
  _navcal_words ''
  for ((i = 1; i < COMP_CWORD; i++)); do
    _navcal_words "${command:+$command }${COMP_WORDS[i]}" && command="${command:+$command }${COMP_WORDS[i]}"
  done
  _navcal_words "$command"
  COMPREPLY=()
  if [[ " $with_value" == *" $before "* ]]; then
    COMPREPLY=($(compgen -f -- "$word"))
  elif [[ $word == -* ]]; then
    COMPREPLY=($(compgen -W "$options" -- "$word"))
  else
    COMPREPLY=($(compgen -W "$commands" -- "$word"))
    [[ ${#COMPREPLY[@]} -eq 0 && -n $command ]] && COMPREPLY=($(compgen -f -- "$word"))
  fi
  return 0
}
complete -o filenames -F _navcal navcal
)";
}

}  // namespace

void add_completion(CLI::App& app) {
  auto* command = app.add_subcommand("completion", "a script that completes navcal's commands in a shell");
  const auto shell = std::make_shared<std::string>();
  command->add_option("SHELL", *shell)->required()->check(CLI::IsMember({"bash", "zsh"}));
  command->callback([&app, shell] {
    const bool zsh = *shell == "zsh";
    // zsh runs what is written for bash. The first line makes it a file for zsh's own folders of completions.
    if (zsh) fmt::print("#compdef navcal\nautoload -U +X bashcompinit && bashcompinit\n");
    fmt::print("{}", script_of(app));
    // zsh loads the file as a function at the first completion, which therefore has to answer in that call,
    // too.
    if (zsh) fmt::print("[[ ${{funcstack[1]-}} == _navcal ]] && _bash_complete -o filenames -F _navcal\n");
  });
}

}  // namespace navcal::cli
