// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "calib/delay/delay_field.h"

namespace navcal::calib::test {

/// The estimator after a whole recording, its readings put in order by the gate; nullopt where there is no such
/// file.
[[nodiscard]] std::optional<FieldDelay> field_delay_of(const std::string& file);

}  // namespace navcal::calib::test
