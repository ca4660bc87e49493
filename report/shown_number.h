// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

// Numbers in the form shown to users.
namespace navcal::report {

/// Two digits of the error, or four of the value if the error is unknown.
[[nodiscard]] int decimals_for(double value, double error);
/// Duration, such as "10 min 2 s"; "-" if it is not finite.
[[nodiscard]] std::string duration_text(double seconds);

}  // namespace navcal::report
