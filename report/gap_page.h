// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "gap/verdict/diagnosis.h"
#include "report/gap_words.h"

namespace navcal::report {

/// The report of `navcal gap --report`: verdict, where, causes, before and after, next steps, as one HTML file.
[[nodiscard]] std::string gap_page(const gap::Diagnosis& diagnosis, const GapSource& source);

}  // namespace navcal::report
