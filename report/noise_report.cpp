// SPDX-License-Identifier: Apache-2.0
#include "report/noise_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/noise/noise_settings.h"
#include "base/append_format.h"
#include "report/shown_number.h"
#include "report/wrapped_text.h"

namespace navcal::report {
namespace {

using analysis::NoiseTerm;

/// Rounding that changes the noise by less is not worth a remark.
constexpr double kVisibleShare = 0.01;

/// Both with the decimals that show two digits of the error.
std::string with_error(double value, double error, std::string_view plus_minus) {
  if (!(error > 0) || !std::isfinite(error)) return fmt::format("{:.4g}", value);
  const int decimals = std::max(1 - static_cast<int>(std::floor(std::log10(error))), 0);
  if (decimals > 9) return fmt::format("{:.4g} {} {:.2g}", value, plus_minus, error);
  return fmt::format("{:.{}f} {} {:.{}f}", value, decimals, plus_minus, error, decimals);
}

std::string term_cell(const NoiseTerm& term, std::string_view plus_minus) {
  if (term.value) return with_error(*term.value, term.error.value_or(0), plus_minus);
  return term.limit ? fmt::format("< {:.2g}", *term.limit) : "-";
}

std::string missing_term(std::string_view name, const NoiseTerm& term, std::string_view unit) {
  if (term.value || (!term.limit && !term.needs_s)) return "";
  std::string words(name);
  if (term.limit) words += fmt::format(" below {:.2g} {}", *term.limit, unit);
  if (term.needs_s) words += fmt::format(" (needs at least {:.0f} s at rest)", *term.needs_s);
  return words;
}

/// Terms without a value: limits, and the length of a recording that would show as much as the limit.
std::string missing_terms(const analysis::AllanFit& terms, std::string_view unit) {
  std::string words;
  const auto add = [&](const std::string& term) {
    if (!term.empty()) words += (words.empty() ? "not seen: " : ", ") + term;
  };
  add(missing_term("white noise", terms.white, fmt::format("{}/sqrt(Hz)", unit)));
  add(missing_term("bias instability", terms.flicker, unit));
  add(missing_term("random walk", terms.walk, fmt::format("{}/sqrt(s)", unit)));
  return words;
}

std::string correlation_sentence(const analysis::ChannelNoise& noise, std::string_view unit) {
  if (!noise.reading || !noise.reading->correlated) return "";
  std::string sentence = fmt::format("consecutive readings are correlated ({:.2f})", noise.reading->lag1);
  if (noise.reading->time_constant_s)
    sentence += fmt::format(", as behind a filter of {:.2g} s", *noise.reading->time_constant_s);
  if (noise.effective)
    sentence += fmt::format("; averages are as noisy as those of independent readings with {} {}",
                            with_error(*noise.effective, noise.effective_error.value_or(0), "+-"), unit);
  return sentence;
}

std::string rounding_sentence(const analysis::ChannelNoise& noise, std::string_view unit) {
  if (!noise.reading || !noise.unrounded || !noise.rounding) return "";
  if (noise.reading->std - *noise.unrounded < kVisibleShare * noise.reading->std) return "";
  return fmt::format("rounding adds {:.3g} {}; without it the noise is {} {}", *noise.rounding, unit,
                     with_error(*noise.unrounded, noise.unrounded_error.value_or(0), "+-"), unit);
}

}  // namespace

std::string rest_sentence(const analysis::NoiseReport& report) {
  if (report.quiet.empty() && report.quietest) {
    const auto& window = *report.quietest;
    return fmt::format(
        "no part is at rest: even in the quietest 8 s, from {:.0f} s on, {} {} {:.3g} {}; rest is below {:.3g} "
        "{}. --from and --to choose a part all the same.",
        window.from_s, window.channel, window.what, window.value, window.unit, window.limit, window.unit);
  }
  if (report.quiet.empty())
    return fmt::format(
        "no part can be judged: it takes 10 s of a channel that shows motion, at least once a second. The "
        "recording is {:.1f} s long. --from and --to choose a part.",
        report.duration_s);
  std::string sentence = report.chosen ? "chosen: " : "at rest: ";
  double length_s = 0;
  for (const auto& interval : report.quiet) {
    if (length_s > 0) sentence += ", ";
    sentence += fmt::format("{:.0f} to {:.0f} s", interval.from_s, interval.to_s);
    length_s += interval.length_s();
  }
  return sentence + fmt::format(" ({})", duration_text(length_s));
}

std::vector<std::string> noise_remarks(const analysis::RecordedChannel& recorded) {
  const analysis::ChannelNoise& noise = recorded.noise;
  const std::string unit(recorded.unit);
  std::vector<std::string> remarks;
  const auto add = [&](std::string remark) {
    if (!remark.empty()) remarks.push_back(std::move(remark));
  };
  add(analysis::why_unknown(recorded));
  if (noise.stretches > 1) add(fmt::format("{} stretches without a gap", noise.stretches));
  add(rounding_sentence(noise, unit));
  add(correlation_sentence(noise, unit));
  for (const auto& line : noise.lines)
    add(fmt::format("line at {:.4g} Hz, amplitude {:.2g} {}", line.frequency_Hz, line.amplitude, unit));
  if (noise.constant || noise.readings == 0) return remarks;
  add(missing_terms(noise.terms, unit));
  return remarks;
}

std::vector<std::string> noise_heads() {
  return {"channel",          "unit",
          "readings",         "rate, Hz",
          "resolution",       "noise of a reading",
          "white, /sqrt(Hz)", "bias instability",
          "walk, /sqrt(s)"};
}

std::vector<std::string> noise_row(const analysis::RecordedChannel& recorded, std::string_view plus_minus) {
  const analysis::ChannelNoise& noise = recorded.noise;
  const bool told = noise.reading && !noise.reading->drifts;
  const std::string of_a_reading = told ? with_error(noise.reading->std, noise.reading->std_error, plus_minus)
                                   : noise.constant ? "constant"
                                                    : "-";
  return {recorded.name(),
          recorded.unit,
          fmt::format("{}", noise.readings),
          noise.rate_Hz > 0 ? fmt::format("{:.2f}", noise.rate_Hz) : "-",
          noise.resolution ? fmt::format("{:.4g}", *noise.resolution) : "-",
          of_a_reading,
          term_cell(noise.terms.white, plus_minus),
          term_cell(noise.terms.flicker, plus_minus),
          term_cell(noise.terms.walk, plus_minus)};
}

std::string noise_text(const analysis::NoiseReport& report) {
  std::string out;
  base::append_format(out, "{}: {}\n{}\n", report.file, duration_text(report.duration_s), rest_sentence(report));
  if (report.channels.empty()) return out + "The recording has no readings.\n";
  if (report.quiet.empty()) return out;
  out += '\n';
  std::vector<std::vector<std::string>> rows{noise_heads()};
  for (const auto& recorded : report.channels) rows.push_back(noise_row(recorded, "+-"));
  // Two texts to the left, numbers to the right.
  const std::vector<std::string> lines = table_lines(rows, 2);
  out += lines[0];
  for (std::size_t i = 0; i < report.channels.size(); ++i) {
    out += lines[i + 1];
    for (const auto& remark : noise_remarks(report.channels[i])) base::append_format(out, "    {}\n", remark);
  }
  return out;
}

}  // namespace navcal::report
