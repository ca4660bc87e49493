// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "config/layout/layout_file.h"
#include "report/gap_words.h"
#include "report/simulators/transfer.h"
#include "report/wrapped_text.h"
#include "sim/layout/effects/layout_effects.h"

namespace navcal::report {
namespace {

/// Makes the change to `layout`. Why it cannot; empty: it is made.
std::string change(const gap::EffectFinding& finding, config::Layout& layout) {
  const auto* const about = sim::find_layout_effect(finding.name);
  if (about == nullptr) return "an error of an instrument is no part of a layout";
  if (const auto refused = sim::owner_refusal(layout, *about, finding.of)) return *refused;
  sim::LayoutEffect effect{about, finding.of, {}};
  for (const sim::EffectParameter& parameter : about->parameters) {
    const auto found = std::ranges::find(finding.parameters, parameter.name, &gap::EffectParameterEstimate::name);
    if (found == finding.parameters.end() || !std::isfinite(found->value))
      return fmt::format("{} is not determined", parameter.name);
    effect.values.push_back(found->value);
  }
  layout = sim::changed_layout(std::move(layout), effect);
  return {};
}

std::string commented(const std::vector<std::string>& paragraphs) {
  std::string text;
  for (const std::string& paragraph : paragraphs) text += comment_lines(printable(paragraph), "# ", 118);
  return text;
}

}  // namespace

SimulatorFile corrected_layout(const gap::Diagnosis& diagnosis, std::string_view origin, config::Layout layout) {
  std::vector<std::string> paragraphs{
      fmt::format("navcal {}: layout corrected by the effects that navcal gap found in {}. {}", NAVCAL_VERSION,
                  origin, verdict_sentence(diagnosis))};
  std::vector<std::string> summary;
  if (const auto why_not = why_no_correction(diagnosis); !why_not.empty()) {
    paragraphs.push_back("This file contains " + why_not + ".");
    return {commented(paragraphs) + config::layout_file(layout), why_not};
  }
  for (const gap::EffectFinding& finding : diagnosis.effects) {
    const std::string reason = change(finding, layout);
    std::vector<std::string> about;
    for (const auto& parameter : finding.parameters) about.push_back(text_of(parameter, "+-"));
    for (const auto& other : finding.confused_with) about.push_back(text_of(other));
    if (!reason.empty()) about.push_back(reason);
    paragraphs.push_back(fmt::format("{}: {}: probability {}; {}.", reason.empty() ? "Corrected" : "Left out",
                                     finding.words(), probability_text(finding.probability),
                                     fmt::join(about, "; ")));
    summary.push_back(reason.empty() ? finding.words()
                                     : fmt::format("left out: {} ({})", finding.words(), reason));
  }
  return {commented(paragraphs) + config::layout_file(layout),
          printable(fmt::format("{}", fmt::join(summary, "; ")))};
}

}  // namespace navcal::report
