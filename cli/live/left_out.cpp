// SPDX-License-Identifier: Apache-2.0
#include <string>

#include "cli/live/commands.h"

namespace navcal::cli {

void add_left_out(CLI::App& parent, const std::string& name) {
  const std::string why = "not in this build, which has what the demo needs";
  CLI::App* const command = parent.add_subcommand(name, why);
  command->allow_extras();
  command->set_help_flag();
  command->callback(
      [text = (parent.get_parent() == nullptr ? "" : parent.get_name() + ' ') + name + " is " + why] {
        throw base::Failure(base::Exit::failed,
                            text + ". For all of navcal:\n  cmake --build --preset release --target navcal");
      });
}

}  // namespace navcal::cli
