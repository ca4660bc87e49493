#pragma once

#include <string>

#include "report/gap_words.h"
#include "gap/verdict/diagnosis.h"

namespace navcal::cli {

/// The answer of `navcal gap` for people, in lines of a terminal.
[[nodiscard]] std::string gap_text(const gap::Diagnosis& diagnosis, const GapSource& source);

}  // namespace navcal::cli
