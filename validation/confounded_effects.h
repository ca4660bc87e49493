// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string_view>
#include <vector>

namespace navcal::validation {

/// Effects with which one effect is easily confounded, and channels in which it shows. Derived from first
/// principles, not from the output of any diagnosis.
struct TrialSignature {
  std::string_view effect;
  /// Library effects that leave nearly the same traces: the column "confounded with" of the specification, and
  /// the twins that were found since. Where the effect is missing from the library, they are its class.
  std::vector<std::string_view> twins;
  /// Channels in which it may well be the strongest excess: where it enters, and where what it enters leads to (a
  /// wrong rate turns the predicted attitude, and with it heading, tilt and field).
  std::vector<std::string_view> channels;
};

/// Signatures of all effects, those of the library and the foreign ones.
[[nodiscard]] std::span<const TrialSignature> trial_signatures();
/// nullptr when there is none of this name.
[[nodiscard]] const TrialSignature* signature_of(std::string_view effect);

struct ConfoundedEffects {
  std::string_view first, second;
};
/// Each two library effects that are easily taken for one another, once.
[[nodiscard]] std::vector<ConfoundedEffects> confounded_pairs();

}  // namespace navcal::validation
