// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>

#include "analysis/emulate_session.h"
#include "sim/state.h"

namespace navcal::analysis {

/// How the emulated vehicle moves from start_ns (UTC) on: by a mission, along a path, or along the path that comes
/// with the program. Throws sim::BadPath or config::Error.
[[nodiscard]] std::unique_ptr<sim::Motion> emulate_motion(const EmulateArguments& arguments,
                                                          std::int64_t start_ns);

}  // namespace navcal::analysis
