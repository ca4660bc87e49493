// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <exception>
#include <functional>

#include "base/failure.h"

namespace navcal::cli {

/// Exit status (docs/cli.md) of a command that ended by this exception: bad_input for a bad recording, path or
/// settings; that of an base::Failure; failed for all else.
[[nodiscard]] base::Exit exit_status_of(const std::exception& error);

/// Does some work. std::invalid_argument becomes an base::Failure with the status `of_arguments`: bad_input
/// where it tells of what the files hold. Other exceptions pass.
void with_exit_statuses(const std::function<void()>& work, base::Exit of_arguments = base::Exit::usage);

}  // namespace navcal::cli
