// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string_view>

#include "gap/verdict/diagnosis.h"

namespace navcal::report {

/// A file that is no saved diagnosis; the message names file, line or key.
class BadDiagnosis : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Reads what `navcal gap --json` wrote, as far as exports need it: verdict, sentence, effects and candidates
/// with sizes and errors, and the Earth's field. Unknown keys are passed over; null is not-a-number. An effect
/// with the key "of", the actuator of a layout that it belongs to, is named "thrust_scale of thruster.2". `name`
/// stands for the file in messages. Throws BadDiagnosis.
[[nodiscard]] gap::Diagnosis gap_from_json(std::string_view json, std::string_view name);

}  // namespace navcal::report
