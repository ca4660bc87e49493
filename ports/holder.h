// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace navcal::ports {

/// Locks the device for this process with flock(2), which, unlike TIOCEXCL, also stops root. False: another
/// process holds the lock. The lock ends with the descriptor, even when the process is killed.
[[nodiscard]] bool lock_device(int fd);

/// Other processes that have the device open, as far as this process may see them, in the form of holders_of();
/// empty: none.
[[nodiscard]] std::string visible_holders_of(const std::string& device);

/// Processes that have the device open, for a message: "navcald (process 812)", several joined by ", "; "this
/// process" for our own; "another user's process" when none can be seen.
[[nodiscard]] std::string holders_of(const std::string& device);

}  // namespace navcal::ports
