// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <utility>

namespace navcal::cli {

/// A command of `parent` and the arguments that its options fill; `run` gets them.
template <class Arguments>
std::pair<CLI::App*, std::shared_ptr<Arguments>> add_command(CLI::App& parent, const std::string& name,
                                                             const std::string& description,
                                                             void (*run)(const Arguments&)) {
  const auto arguments = std::make_shared<Arguments>();
  auto* const command = parent.add_subcommand(name, description);
  command->callback([arguments, run] { run(*arguments); });
  return {command, arguments};
}

/// An option whose value the help calls `value`: "FILE.toml".
template <class T>
CLI::Option* add_valued(CLI::App* command, const std::string& name, const std::string& value, T& to,
                        const std::string& help = {}) {
  return command->add_option(name, to, help)->option_text(value);
}

/// The same, given once for each value.
template <class T>
CLI::Option* add_repeatable(CLI::App* command, const std::string& name, const std::string& value, T& to,
                            const std::string& help = {}) {
  return add_valued(command, name, value, to, help)->allow_extra_args(false);
}

/// An option whose default the help states.
template <class T>
CLI::Option* add_defaulted(CLI::App* command, const std::string& name, T& to, const std::string& help = {}) {
  return command->add_option(name, to, help)->capture_default_str();
}

/// The same for a number within bounds.
template <class Bound, class T>
CLI::Option* add_number(CLI::App* command, const std::string& name, Bound least, Bound most, T& to,
                        const std::string& help = {}) {
  return add_defaulted(command, name, to, help)->check(CLI::Range(least, most));
}

}  // namespace navcal::cli
