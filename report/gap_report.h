// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "base/failure.h"
#include "gap/verdict/diagnosis.h"
#include "report/gap_words.h"

namespace navcal::report {

/// The answer of `navcal gap` as text for a terminal.
[[nodiscard]] std::string gap_text(const gap::Diagnosis& diagnosis, const GapSource& source);

/// The answer of `navcal gap --json` (docs/gap.md): one object, no newline. Values that are not finite are null.
[[nodiscard]] std::string gap_json(const gap::Diagnosis& diagnosis);

/// The report of `navcal gap --report`: verdict, where, causes, before and after, next steps, as one HTML file.
[[nodiscard]] std::string gap_page(const gap::Diagnosis& diagnosis, const GapSource& source);

/// The effects found, in the format of `navcal simulate --effects` (docs/simulator.md), with standard errors
/// beside the values. A value outside the simulator's range is moved to the bound, with a comment. An
/// effect that the simulator does not have is a comment.
[[nodiscard]] std::string gap_effects_file(const gap::Diagnosis& diagnosis);

/// A file that is no saved diagnosis; the message names file, line or key.
class BadDiagnosis : public base::Failure {
 public:
  explicit BadDiagnosis(const std::string& message) : Failure(base::Exit::bad_input, message) {}
};

/// Reads what `navcal gap --json` wrote, as far as exports need it: verdict, sentence, effects and candidates
/// with sizes and errors, and the Earth's field. Unknown keys are passed over; null is not-a-number. `name`
/// stands for the file in messages. Throws BadDiagnosis.
[[nodiscard]] gap::Diagnosis gap_from_json(std::string_view json, std::string_view name);

}  // namespace navcal::report
