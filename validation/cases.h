// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "validation/arms.h"
#include "validation/missions.h"
#include "validation/reference/effects.h"
#include "validation/reference/run.h"

namespace navcal::validation {

/// A truth that is fixed before anybody answers: the digest (SHA-256, record/content_hash.h) is published first,
/// truth and salt after the last answer, and then everybody can reckon that digest = SHA-256(truth salt), the two
/// texts one after the other. Without the salt the few possible truths could be tried one by one.
struct Commitment {
  std::string truth;
  std::string salt;  ///< 32 random bytes of the kernel, in hexadecimal
  std::string digest;
};

[[nodiscard]] Commitment commitment_to(std::string truth);

/// Truth of one case, which a diagnosis must not know before it has answered.
struct TrialCase {
  int number = 1;  ///< from 1
  TrialArm arm = TrialArm::nulls;
  int minutes = 10;                        ///< of each mission
  std::vector<reference::Effect> effects;  ///< as drawn, before the tolerance
  std::string excluded;                    ///< effect that the library is to be without
  reference::VehicleUnderTest vehicle;     ///< the effects and the tolerance
  int place_number = 0;
  TrialPlace place;                              ///< of all missions
  std::array<std::uint64_t, 3> mission_seeds{};  ///< of noise and turn-on biases, each mission its own

  /// Whether the library that the diagnosis has can name what is there (nothing, or effects).
  [[nodiscard]] bool in_library() const;
};

/// The same seed, number, minutes and places give the same case on every machine. `minutes` is that of the
/// missions in arms that have no length of their own; each case takes one of so many places.
[[nodiscard]] TrialCase drawn_case(std::uint64_t seed, int number, int minutes, int places = kTrialPlaces);

/// The parameters that the vehicle really has of an effect, tolerance and all, in the units of the keys.
[[nodiscard]] reference::Effect true_parameters(const reference::Effect& effect,
                                                const reference::VehicleUnderTest& vehicle);

/// The case as a line of JSON: what is sealed.
[[nodiscard]] std::string truth_text(const TrialCase& drawn, std::uint64_t seed);

}  // namespace navcal::validation
