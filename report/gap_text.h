// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "gap/verdict/diagnosis.h"
#include "report/gap_words.h"

namespace navcal::report {

/// The answer of `navcal gap` as text for a terminal.
[[nodiscard]] std::string gap_text(const gap::Diagnosis& diagnosis, const GapSource& source);

}  // namespace navcal::report
