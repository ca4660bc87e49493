// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace navcal::share {

/// A program's commands and options as Markdown, in the words of its --help: what manual pages are made of.
[[nodiscard]] std::string manual(const CLI::App& app);

/// --manual, which prints that and ends the program. To be called once all commands are added.
void add_manual(CLI::App& app);

}  // namespace navcal::share
