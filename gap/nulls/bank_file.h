// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gap/nulls/null_bank.h"

namespace navcal::gap {

/// A bank as a file holds it, with what tells which missions it serves.
struct KeptBank {
  std::vector<double> fingerprint;  ///< of the mission that it was steered by
  NullBank bank;
  Vector3 field_uT{};            ///< the Earth's
  bool field_is_fitted = false;  ///< and not known
};

/// JSON. `model`: what a reader must have in common with the writer.
[[nodiscard]] std::string bank_text(const KeptBank& kept, std::string_view model);

/// Nothing for a text that is no bank, or one of another model, or of another shape than a library of so many
/// unknowns gives, or with numbers that are none.
[[nodiscard]] std::optional<KeptBank> read_bank(std::string_view text, std::string_view model,
                                                Eigen::Index unknowns);

}  // namespace navcal::gap
