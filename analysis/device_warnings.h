// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "analysis/device_check.h"

namespace navcal::analysis {

/// What a user should look at before trusting a description: each one sentence.
[[nodiscard]] std::vector<std::string> warnings_about(const protocols::described::Description& description,
                                                      const DeviceFindings& findings);

}  // namespace navcal::analysis
