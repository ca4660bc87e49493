// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "base/descriptor.h"

namespace navcal::ports {

/// A pair of pseudo-terminal ends: we hold the master, clients open `slave_name`. Raw from the start.
struct PseudoTerminal {
  base::Descriptor master;
  std::string slave_name;
};

/// Throws std::system_error. No client is seen (the master's hang-up flag stands) until one opens the slave.
[[nodiscard]] PseudoTerminal make_pseudo_terminal(int baud);

/// Keeps `link` for this process, until the descriptor closes or the process ends, however it ends. Throws
/// std::runtime_error when another one keeps it.
[[nodiscard]] base::Descriptor keep_link(const std::filesystem::path& link);
/// Makes `link` point to `target` in one step, whatever link was there; makes its folder. Throws
/// std::filesystem::filesystem_error, or std::runtime_error when a file or folder has the name.
void point_link(const std::filesystem::path& link, const std::string& target);
/// Removes `link` if it still points to `target`: another program may have taken the name since.
void remove_link(const std::filesystem::path& link, const std::string& target);

}  // namespace navcal::ports
