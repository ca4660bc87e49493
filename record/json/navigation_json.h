// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "pipeline/navigation.h"

namespace navcal::record {

/// Appends one JSON object (no newline) of class NAV (docs/navigation.md). Live log, status socket and replay
/// share it, so they agree to the byte.
void append_json(std::string& out, const pipeline::NavigationSample& sample);

}  // namespace navcal::record
