// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <filesystem>
#include <string_view>

namespace navcal::daemon {

/// File of the log folder that is there as long as the card may have an order. It contains the configuration.
inline constexpr std::string_view kMotorNote = "motor.commanded";

/// The same note in the state folder of the service, or of the user: found even when the log folder is gone or
/// `config`, the file of the configuration, cannot be read. Empty where there is no such folder.
[[nodiscard]] std::filesystem::path second_note(const std::filesystem::path& config);

/// Orders the safe state by the configuration in `note`, until the card has shown it, for `limit` at most; nothing
/// without a note. False: the card may still have an order.
[[nodiscard]] bool order_safe_state_of(const std::filesystem::path& note, std::chrono::seconds limit);

}  // namespace navcal::daemon
