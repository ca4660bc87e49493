// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>

#include "validation/cases.h"

namespace navcal::validation {

/// Swims the three missions of a case and writes a.cap (to be diagnosed), b.cap and c.cap (held out) into the
/// folder: nothing in or about them tells of the case. Throws Failure when the vehicle was lost or the trial is
/// interrupted, std::system_error.
[[nodiscard]] std::array<std::filesystem::path, 3> write_recordings(const TrialCase& drawn,
                                                                    const std::filesystem::path& folder);

/// Swims one mission and writes its capture. Throws as write_recordings().
void write_recording(const reference::Mission& mission, const reference::VehicleUnderTest& vehicle,
                     std::uint64_t seed, const std::filesystem::path& file);

}  // namespace navcal::validation
