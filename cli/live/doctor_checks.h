// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "config/settings.h"

// One function for each thing that `navcal doctor` looks at. The checks change nothing, but for a file in the log
// folder that is made to time it and removed again.
namespace navcal::cli {

/// Result of one check of what can spoil the data.
struct Finding {
  enum class Severity : std::uint8_t { good, warning, fault };

  Severity severity = Severity::good;
  std::string topic;  ///< "port compass", "clock"
  std::string found;
  std::string mend;  ///< a command, or what to do; empty when all is well
};

using Findings = std::vector<Finding>;

inline Finding good(std::string topic, std::string found) {
  return {Finding::Severity::good, std::move(topic), std::move(found), {}};
}
inline Finding warning(std::string topic, std::string found, std::string mend) {
  return {Finding::Severity::warning, std::move(topic), std::move(found), std::move(mend)};
}
inline Finding fault(std::string topic, std::string found, std::string mend) {
  return {Finding::Severity::fault, std::move(topic), std::move(found), std::move(mend)};
}

inline constexpr const char* kServiceUser = "navcal";

/// Account under which navcald will run.
struct Account {
  std::string name;
  uid_t uid = 0;
  std::vector<gid_t> groups;
};

/// Account of this process.
[[nodiscard]] Account own_account();
/// Account of the service's user, `navcal`, when root calls and that user exists; else that of this process.
[[nodiscard]] Account service_account();

/// True when the account can read and write files of this owner and mode (root always can).
[[nodiscard]] bool may_read_and_write(const Account& account, uid_t owner, gid_t group, mode_t mode);
/// The same for a file; false when it does not exist.
[[nodiscard]] bool may_read_and_write(const Account& account, const std::filesystem::path& file);
/// The name of the group that owns a file, or its number; empty when the file is not there.
[[nodiscard]] std::string group_of(const std::filesystem::path& file);

/// Checks where a port is, who may open it, who holds it, and how long its adapter delays bytes.
[[nodiscard]] Finding check_port(const config::PortSettings& settings, const Account& account);

/// True when nobody listens on this TCP port.
[[nodiscard]] bool is_free(std::uint16_t port, const std::filesystem::path& proc = "/proc");

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

/// One screen for people.
[[nodiscard]] std::string doctor_text(const Findings& findings);
/// One object: {"class": "DOCTOR", "account", "configuration", "findings": [{"severity", "topic", "found",
/// "mend"}], "faults", "warnings"}; mend is null where all is well.
[[nodiscard]] std::string doctor_json(const Findings& findings, const std::string& account,
                                      const std::string& configuration);
[[nodiscard]] std::size_t count_of(const Findings& findings, Finding::Severity severity);

}  // namespace navcal::cli
