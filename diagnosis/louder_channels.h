// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "diagnosis/nominal_bank.h"
#include "gap/verdict/diagnosis.h"

namespace navcal::diagnosis {

/// Channels whose noise power exceeds that of nominal recordings, most first.
[[nodiscard]] std::vector<gap::WhereEntry> louder_channels(const RecordingPower& power,
                                                           std::span<const RecordingPower> nominal);

}  // namespace navcal::diagnosis
