// SPDX-License-Identifier: Apache-2.0
#include "report/simulators/transfer.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cassert>

#include "report/gap_words.h"
#include "report/wrapped_text.h"
#include "sim/effects/choice.h"
#include "sim/effects/effect_table.h"

namespace navcal::report {

SimulatorFile simulator_file(Simulator simulator, const CorrectedModel& model) {
  switch (simulator) {
    case Simulator::sitl: return sitl_parameters(model);
    case Simulator::holoocean: return holoocean_scenario(model);
    case Simulator::stonefish: break;
  }
  return stonefish_scenario(model);
}

namespace {

const gap::EffectParameterEstimate* estimate_of(const gap::EffectFinding& finding, std::string_view parameter) {
  const auto found =
      std::ranges::find_if(finding.parameters, [&](const auto& estimate) { return estimate.name == parameter; });
  return found == finding.parameters.end() ? nullptr : &*found;
}

/// Why the values of the effect cannot be used: a parameter without a value, or beyond the library's bounds. Empty
/// when all can be.
std::string unusable(const gap::EffectFinding& finding) {
  const auto effect = sim::make_effect(finding.name);
  if (!effect) return {};
  for (const auto& parameter : effect->description().parameters) {
    const auto* const estimate = estimate_of(finding, parameter.name);
    if (estimate == nullptr || !std::isfinite(estimate->value))
      return fmt::format("{} is not determined", parameter.name);
    if (auto refused = sim::refusal(parameter, estimate->value)) return *std::move(refused);
  }
  return {};
}

const std::string& name_of(const TransferredEffect& effect) { return effect.name(); }
std::string name_of(const gap::EffectFinding& finding) { return finding.words(); }

template <class Effect>
std::vector<std::string> names_of(const std::vector<Effect>& effects) {
  std::vector<std::string> names;
  for (const Effect& effect : effects) names.push_back(name_of(effect));
  return names;
}

}  // namespace

double TransferredEffect::operator[](std::string_view parameter) const {
  const auto* const estimate = estimate_of(*finding_, parameter);
  assert(estimate != nullptr);
  return estimate->value;
}

Transfer::Transfer(const gap::Diagnosis& diagnosis, Simulator simulator) : simulator_(simulator) {
  if (diagnosis.verdict != gap::Verdict::explained) return;
  for (const auto& finding : diagnosis.effects) {
    const Representation representation = representation_of(finding.words(), simulator);
    if (representation.fidelity == Fidelity::none) {
      left_out_.push_back({finding.words(), std::string(representation.text)});
    } else if (auto reason = unusable(finding); !reason.empty()) {
      left_out_.push_back({finding.name, std::move(reason)});
    } else {
      effects_.emplace_back(finding);
    }
  }
}

const TransferredEffect* Transfer::find(std::string_view name) const {
  const auto found = std::ranges::find_if(effects_, [&](const auto& effect) { return effect.name() == name; });
  return found == effects_.end() ? nullptr : &*found;
}

void Transfer::leave_out(std::string_view name, std::string reason) {
  left_out_.push_back({std::string(name), std::move(reason)});
  std::erase_if(effects_, [&](const auto& effect) { return effect.name() == left_out_.back().effect; });
}

std::string about(const TransferredEffect& effect, Simulator simulator) {
  const auto& finding = effect.finding();
  std::vector<std::string> sizes;
  for (const auto& parameter : finding.parameters) sizes.push_back(text_of(parameter, "+-"));
  const Representation representation = representation_of(finding.name, simulator);
  std::string text = fmt::format(
      "{}: probability {}; {}. {}{}.", finding.name, probability_text(finding.probability), fmt::join(sizes, ", "),
      representation.fidelity == Fidelity::approximate ? "Approximately: " : "", representation.text);
  for (const auto& confusion : finding.confused_with) text += " It " + text_of(confusion) + ".";
  return printable(text);
}

std::string why_no_correction(const gap::Diagnosis& diagnosis) {
  if (diagnosis.verdict == gap::Verdict::explained && !diagnosis.effects.empty()) return {};
  std::string text =
      fmt::format("no correction: the verdict is {}, and no effect is certain", verdict_word(diagnosis.verdict));
  if (diagnosis.verdict == gap::Verdict::unknown && !diagnosis.candidates.empty())
    text += fmt::format(" (candidates: {})", fmt::join(names_of(diagnosis.candidates), ", "));
  return printable(text);
}

std::vector<std::string> about(const CorrectedModel& model, const Transfer& transfer) {
  const gap::Diagnosis& diagnosis = model.diagnosis;
  std::vector<std::string> paragraphs{fmt::format("navcal {}: effects found by navcal gap, for {}.",
                                                  NAVCAL_VERSION, title_of(transfer.simulator())),
                                      fmt::format("Diagnosis of {}: {}. {}", model.origin,
                                                  verdict_word(diagnosis.verdict), verdict_sentence(diagnosis))};
  if (const auto reason = why_no_correction(diagnosis); !reason.empty())
    paragraphs.push_back("This file contains " + reason + ".");
  if (!transfer.effects().empty())
    paragraphs.push_back(fmt::format("Corrected: {}.", fmt::join(names_of(transfer.effects()), ", ")));
  for (const auto& [effect, reason] : transfer.left_out())
    paragraphs.push_back(fmt::format("Left out: {}: {}.", effect, reason));
  paragraphs.emplace_back("Biases of the gyros are not exported: they differ at every power-on.");
  for (std::string& paragraph : paragraphs) paragraph = printable(paragraph);
  return paragraphs;
}

std::string summary_of(const gap::Diagnosis& diagnosis, const Transfer& transfer) {
  if (auto reason = why_no_correction(diagnosis); !reason.empty()) return reason;
  const std::vector<std::string> carried = names_of(transfer.effects());
  std::vector<std::string> left_out;
  for (const auto& [effect, reason] : transfer.left_out())
    left_out.push_back(fmt::format("{} ({})", effect, reason));
  std::string text =
      carried.empty() ? "no effect that it can represent" : fmt::format("{}", fmt::join(carried, ", "));
  if (!left_out.empty()) text += fmt::format("; left out: {}", fmt::join(left_out, "; "));
  return printable(text);
}

std::string comment_lines(std::string_view paragraph, std::string_view prefix, std::size_t width) {
  std::string text, line(prefix);
  const auto end_line = [&] {
    if (line.size() > prefix.size()) text += line + '\n';
    line = prefix;
  };
  for (std::string word : words_of(paragraph)) {
    if (line.size() > prefix.size() && line.size() + 1 + word.size() > width) end_line();
    while (prefix.size() + word.size() > width) {
      const std::size_t piece = width - prefix.size();
      line += word.substr(0, piece);
      word.erase(0, piece);
      end_line();
    }
    if (line.size() > prefix.size()) line += ' ';
    line += word;
  }
  end_line();
  return text;
}

}  // namespace navcal::report
