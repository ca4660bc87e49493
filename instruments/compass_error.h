// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "protocols/tcm2_word.h"

namespace navcal::instruments {

/// Meaning of the error code of a compass sample (TCM2, ICD section 1). What a known code voids is absent from the
/// sample already.
struct CompassError {
  bool distortion = false;          ///< E001, a remark: magnetic distortion near; voids nothing
  bool tilt_out_of_range = false;   ///< E002: heading and tilt are void, the field is not
  bool field_out_of_range = false;  ///< E004: heading and field are void, the tilt is not
  bool unknown = false;             ///< another code: nothing of the word can be relied on

  explicit constexpr CompassError(std::optional<std::uint32_t> code) {
    namespace error = protocols::tcm2::error;
    const std::uint32_t bits = code.value_or(0);
    distortion = (bits & error::kDistortion) != 0;
    tilt_out_of_range = (bits & error::kInclinometerOutOfRange) != 0;
    field_out_of_range = (bits & error::kMagnetometerOutOfRange) != 0;
    constexpr std::uint32_t kKnown =
        error::kDistortion | error::kInclinometerOutOfRange | error::kMagnetometerOutOfRange;
    unknown = (bits & ~kKnown) != 0;
  }
};

}  // namespace navcal::instruments
