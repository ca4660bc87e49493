// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gap/verdict/diagnosis.h"
#include "report/gap_words.h"

// Made-up diagnoses.
namespace navcal::cli::test {

[[nodiscard]] gap::Diagnosis explained_gap();  ///< by motor_field and gyro_scale, of which one has a twin
[[nodiscard]] gap::Diagnosis unknown_gap();
[[nodiscard]] gap::Diagnosis no_gap();
/// Everything that can be is no number, and every text has characters that mean something in HTML.
[[nodiscard]] gap::Diagnosis hostile_gap();

[[nodiscard]] report::GapSource gap_source();

}  // namespace navcal::cli::test
