#pragma once

#include <string>

#include "cli/gap_words.h"
#include "gap/diagnosis.h"

namespace navcal::cli {

/// The report of `navcal gap --report`: verdict, where, causes, before and after, what to do, as one HTML file.
[[nodiscard]] std::string gap_page(const gap::Diagnosis& diagnosis, const GapSource& source);

}  // namespace navcal::cli
