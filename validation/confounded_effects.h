// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "validation/cases.h"

namespace navcal::validation {

/// Effects with which one effect is easily confounded, and channels in which it shows. Derived from the equations,
/// not from the output of any diagnosis.
struct TrialSignature {
  std::string_view effect;
  /// Library effects that leave nearly the same traces: the confounders of its description (sim/effects/library);
  /// none of a foreign effect. Where the effect is missing from the library, they are its class.
  std::vector<std::string_view> confounders;
  /// Channels in which it may well be the strongest excess, by its reference::Trace.
  std::vector<std::string_view> channels;
  /// Instruments and forces whose error it is, strictly: where it enters, not where that leads (docs/trial.md).
  std::vector<std::string_view> sources;
  /// Families of the quantities that a foreign effect follows, as an answer names them (docs/gap.md); empty for an
  /// effect of the library.
  std::vector<std::string_view> families;
};

/// Signatures of all effects of the reference simulator: those of the library, then the foreign ones.
[[nodiscard]] std::span<const TrialSignature> trial_signatures();
/// nullptr when there is none of this name.
[[nodiscard]] const TrialSignature* signature_of(std::string_view effect);

/// Whether an answer names this effect: by its name, and by what it belongs to ("thruster.2" or its name).
[[nodiscard]] bool is_same(const TrialEffect& effect, std::string_view full_name);
/// Whether what an answer names is easily taken for this effect: of the same thruster or axis; weight, buoyancy
/// and balance; drag against thrust; the confounders of its signature.
[[nodiscard]] bool is_confounded(const TrialEffect& effect, std::string_view full_name);

struct ConfoundedEffects {
  std::string_view first, second;
};
/// Each two library effects that are easily taken for one another, once.
[[nodiscard]] std::vector<ConfoundedEffects> confounded_pairs();

}  // namespace navcal::validation
