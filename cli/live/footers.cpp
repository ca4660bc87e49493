// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <sstream>
#include <string>
#include <string_view>

#include "cli/live/commands.h"

namespace navcal::cli {

const char* footers();  // footers.txt

void set_footers(CLI::App& app) {
  constexpr std::string_view kBegin = "\n== navcal";
  for (std::string_view rest = footers(); rest.starts_with(kBegin);) {
    rest.remove_prefix(kBegin.size());
    const std::string_view section = rest.substr(0, rest.find(kBegin));
    rest.remove_prefix(section.size());
    const std::size_t end = section.find('\n');
    std::istringstream names(std::string(section.substr(0, end)));
    CLI::App* command = &app;
    for (std::string name; command != nullptr && names >> name;) {
      const auto found = command->get_subcommands([&](const CLI::App* one) { return one->check_name(name); });
      command = found.empty() ? nullptr : found.front();
    }
    if (command != nullptr)
      command->footer(std::string(section.substr(end + 1, section.find_last_not_of('\n') - end)));
  }
}

}  // namespace navcal::cli
