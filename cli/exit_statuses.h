// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

namespace navcal::cli {

/// Does some work. A bad recording or settings, a wrong argument, and what the system refuses become an
/// analysis::Failure with the exit status of docs/cli.md; other exceptions pass.
void with_exit_statuses(const std::function<void()>& work);

}  // namespace navcal::cli
