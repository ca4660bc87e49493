// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace navcal::ports {

/// Takes the device for ourselves alone with flock(2), which, unlike TIOCEXCL, also stops root. False: somebody
/// else has it. The lock ends with the descriptor, even when the process is killed.
[[nodiscard]] bool lock_device(int fd);

/// Who has the device open, of those that we may see and that are not ourselves, as in holders_of(); empty:
/// nobody.
[[nodiscard]] std::string visible_holders_of(const std::string& device);

/// Who has the device open, for a message: "navcald (process 812)", several joined by ", "; "this process" for
/// ourselves; "another user's process" when nobody can be seen.
[[nodiscard]] std::string holders_of(const std::string& device);

}  // namespace navcal::ports
