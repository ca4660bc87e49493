// SPDX-License-Identifier: Apache-2.0
#include "cli/live/commands.h"
#include "share/manual.h"

namespace navcal::cli {

const char* command_help();  // command_help.txt

void set_help(CLI::App& app) { share::set_help(app, command_help()); }

}  // namespace navcal::cli
