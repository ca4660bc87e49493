// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "validation/run.h"

namespace navcal::validation {

/// Writes the recordings of a case into a fresh folder, has them diagnosed by a process that is told their names
/// and no more, and reads its answer. Absent when it was interrupted.
[[nodiscard]] std::optional<TrialResult> ask(const TrialCase& drawn, const Commitment& seal,
                                             const CaseRunOptions& asking);

}  // namespace navcal::validation
