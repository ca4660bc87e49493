// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "analysis/failure.h"

namespace navcal::cli {

/// Does some work. A bad recording or settings, a wrong argument, and what the system refuses become an
/// analysis::Failure with the exit status of docs/cli.md; other exceptions pass. `of_arguments`: the status of
/// std::invalid_argument; bad_input where it tells of what the files hold.
void with_exit_statuses(const std::function<void()>& work, analysis::Exit of_arguments = analysis::Exit::usage);

}  // namespace navcal::cli
