#pragma once

#include <optional>

#include "validation/run.h"

namespace navcal::cli {

/// Writes the recordings of a case into a fresh folder, has them diagnosed by a process that is told their names
/// and no more, and reads its answer. Absent when it was interrupted.
[[nodiscard]] std::optional<TrialResult> ask(const TrialCase& drawn, const Seal& seal, const TrialAsking& asking);

}  // namespace navcal::cli
