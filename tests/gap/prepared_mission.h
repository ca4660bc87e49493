// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "gap/verdict/prepare.h"

namespace navcal::gap::test {

struct SimulatedMission {
  std::string_view mission = "identification";  ///< a shipped one
  std::string_view effects;                     ///< TOML
  double seconds = 60;
  std::uint64_t seed = 1;
};

/// A short mission with its residuals and a small null bank: enough for properties, too little for a diagnosis.
[[nodiscard]] std::unique_ptr<Prepared> prepared_mission(const SimulatedMission& simulated, const Library& library,
                                                         const BankOptions& bank);

/// A library that holds these effects only.
[[nodiscard]] Library library_of(const std::vector<std::string>& effects);

/// Index of an effect in the library. Throws std::invalid_argument.
[[nodiscard]] std::size_t index_of(const Library& library, std::string_view effect);

}  // namespace navcal::gap::test
