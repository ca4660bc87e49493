// SPDX-License-Identifier: Apache-2.0
#include "analysis/audit/audit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <iterator>
#include <tuple>

#include "base/angles.h"
#include "base/enum_name.h"

namespace navcal::analysis {

std::string_view name_of(Certainty certainty) {
  return base::enum_name<Certainty::nothing>(certainty, {"found", "likely", "cannot say", "nothing found"});
}

void Finding::put(const Bounded& bounds, std::string_view of_unit) {
  value = bounds.value;
  low = bounds.low;
  high = bounds.high;
  unit = of_unit;
}

bool Finding::is_beyond(double least, double most) {
  if (*low > most || *high < least) return true;
  if (*low >= least && *high <= most) return false;
  certainty = Certainty::cannot_say;
  sentence += fmt::format(" The interval is too wide to tell whether it is beyond {:.3g}{}{}.", most,
                          unit.empty() ? "" : " ", unit);
  return false;
}

Finding Finding::cannot(std::string why, std::string remedy) const {
  Finding open = *this;
  open.certainty = Certainty::cannot_say;
  open.sentence = std::move(why);
  open.todo = std::move(remedy);
  return open;
}

void Finding::put_heading(double error_deg, double speed_m_s) {
  heading_deg = error_deg;
  position_m = speed_m_s * kCostTime_s * 2 * std::sin(std::min(error_deg, 180.0) * base::kRadiansPerDegree / 2);
}

void sort_findings(std::vector<Finding>& findings) {
  std::stable_sort(findings.begin(), findings.end(), [](const Finding& a, const Finding& b) {
    return std::tuple(a.certainty, -a.position_m.value_or(0)) < std::tuple(b.certainty, -b.position_m.value_or(0));
  });
}

bool Audit::nothing_found() const {
  return std::all_of(files.begin(), files.end(), [](const AuditedFile& file) {
    return std::all_of(file.findings.begin(), file.findings.end(), [](const Finding& finding) {
      return finding.certainty != Certainty::found && finding.certainty != Certainty::likely;
    });
  });
}

std::vector<AuditChange> Audit::changes() const {
  std::vector<AuditChange> changes;
  const auto add = [&](const Finding& old, const Finding& now, const std::string& file) {
    if (old.name != now.name || old.channel != now.channel || old.unit != now.unit || !old.value || !now.value)
      return;
    if (!(*old.high > *old.low) || !(*now.high > *now.low)) return;
    const double difference = *now.value - *old.value;
    const double low = difference - std::hypot(*now.value - *now.low, *old.high - *old.value);
    const double high = difference + std::hypot(*now.high - *now.value, *old.value - *old.low);
    if (low <= 0 && high >= 0) return;
    changes.push_back({file, old.name, old.channel, old.unit,
                       fmt::format("{}, {}: from {:.4g} to {:.4g} {}, a change of {:.3g} to {:.3g}.", old.title,
                                   old.channel, *old.value, *now.value, old.unit, low, high),
                       *old.value, *now.value, low, high});
  };
  for (std::size_t i = 1; i < files.size(); ++i) {
    for (const Finding& old : files.front().findings) {
      for (const Finding& now : files[i].findings) add(old, now, files[i].file);
    }
  }
  return changes;
}

namespace {

/// Leaves out the consequences of what is wrong with rates, forces or axes: they have one cause.
void leave_out_consequences(std::vector<Finding>& findings, const AuditedLog& log) {
  constexpr double kLeastField_uT = 10, kMostField_uT = 140;  // of a field in the right unit, with strong iron
  constexpr std::string_view kAll[]{"gyro.bias",     "gyro.scale",   "compass.step",
                                    "compass.motor", "compass.iron", "compass.heading"};
  const auto leave_out = [&](std::string_view words, std::initializer_list<std::string_view> also, auto is_cause) {
    const auto found = std::find_if(findings.begin(), findings.end(), [&](const Finding& finding) {
      return (finding.certainty <= Certainty::likely || finding.name == "sampling.times") && is_cause(finding);
    });
    if (found == findings.end()) return;
    const std::string why = fmt::format("{}: {}", words, found->sentence), todo = found->todo;
    for (Finding& finding : findings) {
      const auto is_of = [&](std::string_view name) { return finding.name.starts_with(name); };
      if (std::ranges::any_of(kAll, is_of) || std::ranges::any_of(also, is_of))
        finding = Finding{finding.name, finding.title, finding.channel}.cannot(why, todo);
    }
  };
  leave_out("The rates are not what they should be", {"delay.", "compass.axes"}, [](const Finding& of) {
    return of.name.starts_with("convention.") && (of.channel.starts_with("rate") || of.channel == "body");
  });
  leave_out("The times are not known", {"delay.", "force.vibration"},
            [](const Finding& of) { return of.name == "sampling.times"; });
  leave_out("The axes of the field are not what they should be", {"delay."},
            [](const Finding& of) { return of.name == "compass.axes"; });
  // The calibrators count with the noise of a field in microtesla.
  leave_out("The size of the field is not what it should be", {"delay."}, [&](const Finding& of) {
    return of.name == "compass.size" && of.channel == log.compass &&
           (of.value < kLeastField_uT || of.value > kMostField_uT);
  });
  // The delay of a field behind the rates needs no tilt.
  leave_out("The forces that tell the tilt are disturbed",
            {log.all("field_x").empty() ? "delay." : "delay.course"},
            [](const Finding& of) { return of.name.starts_with("force."); });
  // Several steps of the field need the reason once.
  const auto is_again = [](const Finding& a, const Finding& b) {
    return b.certainty == Certainty::cannot_say &&
           std::tie(a.name, a.channel, a.sentence) == std::tie(b.name, b.channel, b.sentence);
  };
  findings.erase(std::unique(findings.begin(), findings.end(), is_again), findings.end());
}

/// One quantity in two ways. Where they agree, the first says it. Where not, one of them is wrong: what the first,
/// which assumes least, says is likely then, and the others say nothing.
void compare_ways(std::vector<Finding>& findings) {
  const auto contradicts = [](const Finding& by) {
    return fmt::format("{} contradicts it: {:.3g} to {:.3g} {}.", by.title, *by.low, *by.high, by.unit);
  };
  for (auto first = findings.begin(); first != findings.end(); ++first) {
    for (auto other = first + 1; other != findings.end(); ++other) {
      if (first->quantity.empty() || other->quantity != first->quantity || !first->value || !other->value)
        continue;
      if (*first->low <= *other->high && *other->low <= *first->high) {
        if (first->certainty <= Certainty::likely) other = std::prev(findings.erase(other));
        continue;
      }
      first->sentence += " " + contradicts(*other);
      if (first->certainty == Certainty::found) first->certainty = Certainty::likely;
      *other = Finding{other->name, other->title, other->channel}.cannot(contradicts(*first),
                                                                         "Look which of the two is disturbed.");
    }
  }
}

}  // namespace

AuditedFile audited(const AuditedLog& log, std::vector<Finding> more) {
  AuditedFile file{log.file, log.duration_s, log.speed_m_s(), log.is_partial, log.remarks, std::move(more)};
  for (const auto group : {sampling_findings, compass_findings, inertial_findings, water_findings}) {
    auto findings = group(log);
    std::move(findings.begin(), findings.end(), std::back_inserter(file.findings));
  }
  leave_out_consequences(file.findings, log);
  compare_ways(file.findings);
  sort_findings(file.findings);
  return file;
}

Finding refused(const Finding& finding, const calib::CalibratorReport& report) {
  const auto sentence_of = [](std::string words) {
    if (!words.empty()) words.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(words.front())));
    return words.empty() ? words : words + ".";
  };
  return finding.cannot(sentence_of(report.judgement.reason), sentence_of(report.judgement.manoeuvre));
}

}  // namespace navcal::analysis
