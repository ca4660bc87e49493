// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string_view>

namespace navcal::api {

/// Gets the current step of a long job and the share of it that is done, 0 to 1. The job goes on while the
/// callback returns true; with false it ends by an Error of the kind `cancelled`. What the callback throws ends
/// the job as well and reaches the caller unchanged. Called from one thread at a time, which need not be the
/// caller's. An empty function: nobody is told.
using Progress = std::function<bool(std::string_view step, double share)>;

}  // namespace navcal::api
