#pragma once

#include <string>

#include "report/gap_words.h"
#include "gap/verdict/diagnosis.h"

namespace navcal::cli {

/// The report of `navcal gap --report`: verdict, where, causes, before and after, what to do, as one HTML file.
[[nodiscard]] std::string gap_page(const gap::Diagnosis& diagnosis, const GapSource& source);

}  // namespace navcal::cli
