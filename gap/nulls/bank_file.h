// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

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

}  // namespace navcal::gap
