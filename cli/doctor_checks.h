// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>

#include "cli/doctor_account.h"
#include "cli/doctor_finding.h"
#include "config/settings.h"

// One function for each thing that `navcal doctor` looks at. The checks change nothing, but for a file in the log
// folder that is made to time it and removed again.
namespace navcal::cli {

/// Checks where a port is, who may open it, who holds it, and how long its adapter delays bytes.
[[nodiscard]] Finding check_port(const config::PortSettings& settings, const Account& account);

/// Checks who listens on the address of the status socket. `proc` and `etc` stand for these folders of the
/// system.
[[nodiscard]] Finding check_status_port(const config::StatusSettings& settings,
                                        const std::filesystem::path& proc = "/proc",
                                        const std::filesystem::path& etc = "/etc");

/// Checks whether the log can be written, for how long, and how long it takes until a record is safe.
/// `etc` stands for this folder of the system.
[[nodiscard]] Finding check_log_folder(const config::LogSettings& settings, const Account& account,
                                       const std::filesystem::path& etc = "/etc");

/// Writes the drop-in of navcald.service for a log folder that the shipped unit keeps it from. A file that is
/// there is left alone. Throws std::system_error.
[[nodiscard]] Finding fix_log_folder(const config::LogSettings& settings, const Account& account,
                                     const std::filesystem::path& etc = "/etc");

/// Checks whether UTC is known.
[[nodiscard]] Finding check_clock();
/// State of the kernel's clock.
struct ClockState {
  bool synchronised = false;
  double max_error_s = 0;
};
[[nodiscard]] Finding judge_clock(const ClockState& state);

/// Checks that the limit of open files suffices for all ports and clients. Real-time priority is only reported.
[[nodiscard]] Finding check_limits(const config::Settings& settings);
[[nodiscard]] Finding judge_limits(std::uint64_t descriptors, std::uint64_t real_time_priority,
                                   const config::Settings& settings);

}  // namespace navcal::cli
