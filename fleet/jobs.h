// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "config/layout.h"
#include "config/settings.h"
#include "config/vehicle.h"

namespace navcal::fleet {

/// All that the answer of a task depends on; threads do not change it.
struct JobInput {
  std::filesystem::path recording;
  config::VehicleSettings vehicle;
  std::optional<config::Layout> layout;         ///< instead of `vehicle`
  std::vector<std::filesystem::path> nominals;  ///< of a layout: its recordings without a gap
  std::optional<config::Settings> settings;     ///< instead of the recording's own
  std::filesystem::path bank_folder;            ///< holds the null bank; empty: there is none
  int bank_missions = 0;
  std::uint64_t bank_seed = 0;
  unsigned threads = 1;
};

/// Something that is done with one recording.
struct Job {
  std::string_view name;  ///< as in `navcal fleet plan --job`
  bool uses_vehicle;      ///< the answer depends on the nominal vehicle
  bool uses_bank;         ///< a null bank is made first, but for a layout
  /// The answer as one JSON object without what depends on machine, time and place: the same input gives the same
  /// bytes. Throws what a recording that cannot be read throws.
  std::string (*answer)(const JobInput& input);
};

/// Name of the job that makes a null bank. Plans add it where a job uses one; it is not in jobs().
inline constexpr std::string_view kBankJob = "bank";

[[nodiscard]] std::span<const Job> jobs();
/// Null bank and its answer: `bank_folder` gets the bank. Used like the jobs of the table.
[[nodiscard]] const Job& bank_job();
/// Any job by its name, that of banks included. Throws std::invalid_argument, which lists the names.
[[nodiscard]] const Job& job_named(std::string_view name);

}  // namespace navcal::fleet
