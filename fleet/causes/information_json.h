// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "gap/verdict/information.h"

namespace navcal::fleet {

/// Information of a recording as the answer of the job `evidence` (docs/fleet.md). Numbers keep all their digits.
[[nodiscard]] nlohmann::ordered_json information_json(const gap::RecordingInformation& information);

/// The reverse. Throws std::invalid_argument, which names the key that is missing or of the wrong shape.
[[nodiscard]] gap::RecordingInformation information_from(const nlohmann::ordered_json& json);

}  // namespace navcal::fleet
