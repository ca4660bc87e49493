// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

// Numbers as people read them.
namespace navcal::report {

/// Two digits of the error, or four of the value where the error is not known.
[[nodiscard]] int decimals_for(double value, double error);
/// "10 min 2 s"; "-" for what is no number.
[[nodiscard]] std::string duration_text(double seconds);

}  // namespace navcal::report
