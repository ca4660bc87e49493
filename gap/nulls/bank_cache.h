// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "config/vehicle.h"
#include "gap/data/innovations.h"
#include "gap/inference/library.h"
#include "gap/nulls/null_bank.h"

namespace navcal::gap {

/// Content of a bank's file: the bank, and the features of the missions that it serves.
struct KeptBank {
  std::vector<double> fingerprint;  ///< of the mission that it was steered by
  NullBank bank;
  Vector3 field_uT{};            ///< the Earth's
  bool field_is_fitted = false;  ///< and not known
};

/// Bank as JSON. `model`: what reader and writer must have in common.
[[nodiscard]] std::string bank_text(const KeptBank& kept, std::string_view model);

/// Parses a bank. Empty for a text that is no bank, is one of another model or of another number of unknowns,
/// or contains numbers that are not finite.
[[nodiscard]] std::optional<KeptBank> read_bank(std::string_view text, std::string_view model,
                                                Eigen::Index unknowns);

/// Null banks of missions that were diagnosed before. A bank serves every mission that was steered alike: the
/// same shaft speeds, turns, depths, fixes and field of the Earth within a tolerance. Nominal vehicle,
/// instruments, what of them is silent and when, library and program must be equal. The folder holds at most
/// kMostBanks banks; the least recently used one is removed first.
class BankCache {
 public:
  static constexpr std::size_t kMostBanks = 64;  ///< of about 0.3 MB each
  /// Empty folder: no bank is kept.
  BankCache(std::filesystem::path folder, const config::VehicleSettings& vehicle, const Library& library);

  /// The nearest bank of about so many missions (nine tenths at least), if it is near enough. A file that is no
  /// valid bank is skipped.
  [[nodiscard]] std::optional<NullBank> find(const Replay& replay, const Trajectory10Hz& course,
                                             const BankOptions& options) const;
  /// Returns why the bank could not be kept; empty: it is kept, or there is no folder for it.
  [[nodiscard]] std::string keep(const Replay& replay, const Trajectory10Hz& course, const NullBank& bank) const;

 private:
  /// Text that must be equal for a bank to serve: program, vehicle, library, instruments and silences.
  [[nodiscard]] std::string model_of(const Replay& replay) const;

  std::filesystem::path folder_;
  std::string model_;  ///< of program, vehicle and library
  Eigen::Index unknowns_ = 0;
};

}  // namespace navcal::gap
