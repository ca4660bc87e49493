// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gap/verdict/diagnosis.h"

// What a diagnosis says, in words and units of people: shared by the text and the page of `navcal gap`.
namespace navcal::report {

/// What a diagnosis was made from.
struct GapSource {
  std::string mission;
  std::vector<std::string> holdouts;
  std::string vehicle;  ///< empty: the reference vehicle
  std::vector<std::string> excluded;
  std::string effects_file;  ///< written with --effects-out; empty: not
  std::string config{};      ///< of all recordings; empty: their own
};

/// "no gap", "explained", "unknown".
[[nodiscard]] std::string_view verdict_word(gap::Verdict verdict);
[[nodiscard]] std::string verdict_sentence(const gap::Diagnosis& diagnosis);

/// Those that the sentence does not say already.
[[nodiscard]] std::vector<std::string> further_remarks(const gap::Diagnosis& diagnosis);

/// Where it lies if no place can be named.
[[nodiscard]] std::string nowhere_text(const gap::Diagnosis& diagnosis);

/// "motor_current" as "motor current".
[[nodiscard]] std::string spaced(std::string_view name);
/// Three digits and the unit; "-" for what is no number.
[[nodiscard]] std::string amount(double value, std::string_view unit = {});
/// "98 %".
[[nodiscard]] std::string share_text(double share);
/// "99.3 %", "> 99.9 %".
[[nodiscard]] std::string probability_text(double probability);
/// Said where candidates are listed under the verdict unknown. Their probabilities compare them with each other
/// and with no effect at all, which is no evidence that any of them is the cause, so they are not shown.
inline constexpr std::string_view kNoneExplains =
    "Best fits of the library first; none of them explains the recording.";
/// "1e-9", "0.03".
[[nodiscard]] std::string chance_text(double p_value);

/// "x 0.803 +- 0.004 uT/A"; `plus_minus` stands between value and error.
[[nodiscard]] std::string text_of(const gap::EffectParameterEstimate& parameter, std::string_view plus_minus);
/// "may as well be adc_droop (3.1 nats apart); what tells them apart: current steps".
[[nodiscard]] std::string text_of(const gap::Confusion& confusion);

/// "98 % (95 to 100 %)", or that there was nothing to close.
[[nodiscard]] std::string closed_text(const gap::Closure& closure);
/// "14.2 -> 1.05 uT, floor 1.03".
[[nodiscard]] std::string levels_text(const gap::Closure& closure, std::string_view unit, std::string_view arrow);
/// "noise power 9.1, of the nominal vehicle 1.03": where nothing was found to close it with.
[[nodiscard]] std::string size_text(const gap::Closure& closure);
/// "on 2 recordings held out".
[[nodiscard]] std::string judged_on(const gap::Gap& gap, const GapSource& source);
/// Heading and dead reckoning, before and after, one sentence each.
[[nodiscard]] std::vector<std::string> consequences(const gap::Gap& gap, std::string_view arrow);
/// Where causes cannot be sought: a line for each calibrator, what it found of its instruments or why it cannot
/// say.
[[nodiscard]] std::vector<std::string> instruments_alone_lines(const calib::Report& report,
                                                               std::string_view plus_minus);
/// "compass.field at 312 s: 0.1 -> 2.3 uT".
[[nodiscard]] std::string text_of(const gap::ChangePoint& change, std::string_view arrow);
[[nodiscard]] std::string bank_text(const gap::BankFacts& bank);
/// With which what was found is simulated, or how to get there; empty when nothing was found.
[[nodiscard]] std::string simulate_hint(const gap::Diagnosis& diagnosis, const GapSource& source);

}  // namespace navcal::report
