// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <string>

#include "cli/live/commands.h"

namespace navcal::cli {

void add_left_out(CLI::App& parent, const std::string& name) {
  CLI::App* const command = parent.add_subcommand(name, "not in this build, which has what the demo needs");
  command->allow_extras();
  command->set_help_flag();
  command->callback([called = (parent.get_parent() == nullptr ? "" : parent.get_name() + ' ') + name] {
    throw base::Failure(base::Exit::failed,
                        fmt::format("{} is not in this build, which has what the demo needs. For all of navcal:\n"
                                    "  cmake --build --preset release --target navcal",
                                    called));
  });
}

}  // namespace navcal::cli
