// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "gap/verdict/diagnosis.h"

// Words and units for the results of a diagnosis, shared by text and page of `navcal gap`.
namespace navcal::report {

/// Inputs of a diagnosis.
struct GapSource {
  std::vector<std::string> missions;  ///< diagnosed together
  std::vector<std::string> holdouts;
  std::string vehicle;  ///< empty: the reference vehicle
  std::vector<std::string> excluded;
  std::string effects_file;  ///< file of --effects-out; empty without it
  std::string config{};      ///< configuration of all recordings; empty: their own
};

/// Verdict: "no gap", "explained", "unknown".
[[nodiscard]] std::string_view verdict_word(gap::Verdict verdict);
[[nodiscard]] std::string verdict_sentence(const gap::Diagnosis& diagnosis);

/// Remarks that the sentence does not contain already.
[[nodiscard]] std::vector<std::string> further_remarks(const gap::Diagnosis& diagnosis);

/// Text for "where" if no place can be named.
[[nodiscard]] std::string nowhere_text(const gap::Diagnosis& diagnosis);

/// Where the error enters: the leading source, and the next best with its distance. Empty if no source describes
/// the gap clearly.
[[nodiscard]] std::string source_text(const gap::Diagnosis& diagnosis);
/// Warning with each description of an unknown gap.
inline constexpr std::string_view kDescriptionNotCause =
    "This describes the residuals. It is no cause: another effect may leave the same trace.";
/// Description of an unknown gap, a line for each error, then what it predicts of other data and the warning.
/// Empty if there is none.
[[nodiscard]] std::vector<std::string> proposal_lines(const gap::Diagnosis& diagnosis, std::string_view plus_minus,
                                                      std::string_view arrow);

/// Name as words: "motor_current" as "motor current".
[[nodiscard]] std::string spaced(std::string_view name);
/// Three digits and the unit; "-" if the value is not finite.
[[nodiscard]] std::string amount(double value, std::string_view unit = {});
/// Percentage, such as "98 %".
[[nodiscard]] std::string share_text(double share);
/// Probability, such as "99.3 %" or "> 99.9 %".
[[nodiscard]] std::string probability_text(double probability);
/// Heading of the candidates under the verdict unknown. Their probabilities compare them with each other and with
/// no effect at all. That is no evidence that one of them is the cause, so they are shown of an ambiguous gap
/// only.
[[nodiscard]] std::string_view candidates_heading(gap::UnknownKind kind);
/// p-value, such as "1e-9" or "0.03".
[[nodiscard]] std::string chance_text(double p_value);

/// Parameter, such as "x 0.803 +- 0.004 uT/A"; `plus_minus` stands between value and error.
[[nodiscard]] std::string text_of(const gap::EffectParameterEstimate& parameter, std::string_view plus_minus);
/// Confounded effect, such as "may as well be adc_droop (3.1 nats apart); told apart by: current steps".
[[nodiscard]] std::string text_of(const gap::Confusion& confusion);

/// Closure, such as "98 % (95 to 100 %)", or that there was nothing to close.
[[nodiscard]] std::string closed_text(const gap::Closure& closure);
/// Residual of a channel, such as "14.2 -> 1.05 uT, floor 1.03".
[[nodiscard]] std::string levels_text(const gap::Closure& closure, std::string_view unit, std::string_view arrow);
/// Size of the gap if no effect closes it: "noise power 9.1, of the nominal vehicle 1.03".
[[nodiscard]] std::string size_text(const gap::Closure& closure);
/// Basis of the judgement, such as "on 2 held-out recordings".
[[nodiscard]] std::string judged_on(const gap::Gap& gap, const GapSource& source);
/// Heading and dead reckoning, before and after, one sentence each.
[[nodiscard]] std::vector<std::string> consequences(const gap::Gap& gap, std::string_view arrow);
/// One line for each calibrator if causes cannot be searched for: its estimate, or the reason why there is none.
[[nodiscard]] std::vector<std::string> instruments_alone_lines(const calib::Report& report,
                                                               std::string_view plus_minus);
/// A change of level, such as "compass.field at 312 s: 0.1 -> 2.3 uT".
[[nodiscard]] std::string text_of(const gap::ChangePoint& change, std::string_view arrow);
[[nodiscard]] std::string bank_text(const gap::BankFacts& bank);
/// Command that simulates the effects found, or the way to it; empty if there are none.
[[nodiscard]] std::string simulate_hint(const gap::Diagnosis& diagnosis, const GapSource& source);

/// Splits a parameter's name into name and unit: "x_uT_per_A" is "x" in "uT/A", "deg_per_s_per_C_ax" is "ax" in
/// "deg/s/C", "per_A" is nameless in "1/A", "gain" has no unit.
struct NameAndUnit {
  std::string name, unit;
};
[[nodiscard]] NameAndUnit name_and_unit(std::string_view parameter);

}  // namespace navcal::report
