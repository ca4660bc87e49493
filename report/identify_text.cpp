// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "report/identify_report.h"
#include "report/wrapped_text.h"

namespace navcal::report {

std::vector<std::string> identify_heads() { return {"number", "file", "fitted", "unit", ""}; }

std::vector<std::string> identify_row(const identify::IdentifiedParameter& one, std::string_view between) {
  return {one.parameter.name,
          fmt::format("{:.4g} {} {:.2g}", one.parameter.prior, between, one.parameter.prior_std),
          fmt::format("{:.4g} {} {:.2g}", one.value, between, one.std), one.parameter.unit,
          one.is_identified ? "" : "not told"};
}

std::string rms_sentence(std::string_view what, const identify::BeforeAfter& rms) {
  return fmt::format("{}: whitened innovations {:.3f} with the numbers of the file, {:.3f} with the fitted ones",
                     what, rms.before, rms.after);
}

std::string prediction_phrase(const identify::PredictionFit& of) {
  return fmt::format(
      "predicted {:.0f} s ahead, from {} starts: {} off by {:.3g} {} with the numbers of the file, {:.3g} with "
      "the fitted ones{}",
      of.after_s, of.starts, of.quantity, of.before, of.unit, of.after,
      of.linear ? fmt::format(", {:.3g} by a linear regression", *of.linear) : "");
}

std::string disturbance_phrase(const identify::DisturbanceFit& of) {
  return fmt::format("{:.2g} {} in {}{}", of.coloured, of.unit, of.axis,
                     of.share ? fmt::format(", {:.0f} % of what the actuators give", 100 * *of.share) : "");
}

std::string manoeuvre_sentence(const identify::ManoeuvreAdvice& advice) {
  return fmt::format("{:.0f} s of {}: standard error of {} from {:.2g} to {:.2g}", advice.seconds,
                     advice.manoeuvre, advice.parameter, advice.std_before, advice.std_after);
}

std::string identify_text(const identify::Identification& found) {
  std::vector<std::vector<std::string>> rows{identify_heads()};
  for (const auto& one : found.parameters) rows.push_back(identify_row(one, "+-"));
  std::string out = fmt::format("{:.0f} s of recordings, {} steps{}\n\n", found.seconds, found.iterations,
                                found.converged ? "" : ", not settled");
  for (const std::string& line : table_lines(rows, rows.front().size())) out += line;
  out += '\n' + rms_sentence("these recordings", found.fitted) + '\n';
  if (found.held_out) out += rms_sentence("held-out recordings", *found.held_out) + '\n';
  for (const auto& one : found.predictions) out += "  " + prediction_phrase(one) + '\n';
  out += fmt::format("\nunknown forces that last for {:.0f} s, over mass:\n", found.disturbance_tau_s);
  for (const auto& of : found.disturbances) out += "  " + disturbance_phrase(of) + '\n';
  if (!found.directions.empty()) out += "\nwhat the recordings do not tell:\n";
  for (const auto& direction : found.directions) out += "  " + direction.words + '\n';
  if (!found.manoeuvres.empty()) out += "\nwhat would tell more:\n";
  for (const auto& advice : found.manoeuvres) out += "  " + manoeuvre_sentence(advice) + '\n';
  return out;
}

}  // namespace navcal::report
