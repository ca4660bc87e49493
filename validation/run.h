// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "validation/judge.h"

namespace navcal::validation {

/// How the diagnosis is asked.
struct CaseRunOptions {
  std::filesystem::path program = "/proc/self/exe";
  std::optional<int> bank_missions;
  std::vector<std::string> without;  ///< instruments that the diagnosis has to do without (navcal gap --without)
  std::chrono::seconds timeout{600};
  unsigned jobs = 1;
  std::filesystem::path keep;  ///< empty: recordings are removed once they are answered
};

struct TrialRun {
  std::vector<TrialResult> results;  ///< in order of their numbers
  std::string ended_early;           ///< why, where not all were asked
};

/// Asks about all cases, `jobs` of them at a time; the first of each kind of missions alone, so that its null
/// missions are made once. Each answer is handed to `answered`, never two at a time; the truth is in it, and must
/// stay there until the last one has come. Ends early on Ctrl-C and where going on is no use, such as on a full
/// disk.
[[nodiscard]] TrialRun ask_all(const std::vector<TrialCase>& cases, const std::vector<Commitment>& seals,
                               const CaseRunOptions& asking,
                               const std::function<void(const TrialResult&)>& answered);

}  // namespace navcal::validation
