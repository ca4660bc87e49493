// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace navcal::validation {

enum class TrialVerdict : std::uint8_t { no_gap, explained, unknown, cannot_say };
/// "no-gap", "explained", "unknown", "cannot-say" (the recording does not show it).
[[nodiscard]] std::string_view name_of(TrialVerdict verdict);

struct TrialEstimate {
  double value = 0;
  std::optional<double> std_error;
};

struct TrialFinding {
  std::string name;  ///< with what it belongs to, if the answer says so: "thrust_scale of thruster.2"
  double probability = 0;
  std::map<std::string, TrialEstimate, std::less<>> parameters;
};

/// The scored part of the answer of `navcal gap --json`.
struct TrialAnswer {
  TrialVerdict verdict = TrialVerdict::unknown;
  std::vector<std::string> channels;  ///< strongest excess first
  std::vector<std::string> sources;   ///< where the error enters, most probable first; as far as it was told
  /// Families of the quantities that the proposal's leading error follows, other than a constant one; as far as it
  /// was told.
  std::vector<std::string> families;
  std::vector<TrialFinding> effects;     ///< on which the verdict rests, most probable first
  std::vector<TrialFinding> candidates;  ///< what was considered besides; as far as it was told
  std::vector<std::string> twins;        ///< with which effects and candidates are said to be confused
  std::optional<double> closed;
  std::optional<std::array<double, 2>> closed_ci;
  std::optional<double> seconds;  ///< that the diagnosis took by its own account, without null missions
};

/// Throws std::runtime_error, which says what is wrong and where: it is no JSON, a key is missing or of another
/// type, a number cannot be, or the verdict contradicts the effects.
[[nodiscard]] TrialAnswer read_answer(std::string_view json);

}  // namespace navcal::validation
