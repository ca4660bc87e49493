// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "config/vehicle.h"
#include "gap/data/innovations.h"
#include "gap/inference/library.h"
#include "gap/nulls/null_bank.h"

namespace navcal::gap {

/// Null banks of missions that were diagnosed before. A bank serves every mission that was steered alike: the same
/// shaft speeds, turns, depths, fixes and field of the Earth within a tolerance, by the same nominal vehicle,
/// instruments, library and program. The folder holds at most kMostBanks of them; the one that was not used for
/// longest goes.
class BankCache {
 public:
  static constexpr std::size_t kMostBanks = 64;  ///< of about 0.3 MB each
  /// Empty folder: nothing is kept.
  BankCache(std::filesystem::path folder, const config::VehicleSettings& vehicle, const Library& library);

  /// The bank of at least so many missions whose own mission is nearest, if it is near enough. A file that cannot
  /// be read as one is passed over.
  [[nodiscard]] std::optional<NullBank> find(const Replay& replay, const Trajectory10Hz& course,
                                             const BankOptions& options) const;
  /// Returns why the bank could not be kept; empty: it is kept, or there is no folder for it.
  [[nodiscard]] std::string keep(const Replay& replay, const Trajectory10Hz& course, const NullBank& bank) const;

 private:
  /// What else must be the same.
  [[nodiscard]] std::string model_of(const Replay& replay) const;

  std::filesystem::path folder_;
  std::string model_;  ///< of program, vehicle and library
  Eigen::Index unknowns_ = 0;
};

}  // namespace navcal::gap
