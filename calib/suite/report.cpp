// SPDX-License-Identifier: Apache-2.0
#include "calib/suite/report.h"

#include <algorithm>
#include <array>
#include <cstdio>

#include "base/enum_name.h"
#include "base/utc_text.h"

namespace navcal::calib {

std::string_view name_of(Verdict verdict) {
  return base::enum_name<Verdict::in_force>(verdict, {"refused", "shadow", "in_force"});
}

std::string_view name_of(Outcome outcome) {
  return base::enum_name<Outcome::accepted>(outcome, {"refused", "no better", "accepted"});
}

std::string objection_of(const CalibratorReport& report) {
  const auto& judgement = report.judgement;
  if (report.outcome == Outcome::no_better) {
    return std::string("the data support the estimate, but held-out readings are no better with it") +
           (report.verdict == Verdict::in_force ? "; one made earlier is in force, and not shown to be worse"
                                                : "");
  }
  if (judgement.accepted || judgement.manoeuvre.empty()) return judgement.reason;
  return judgement.reason.empty() ? judgement.manoeuvre : judgement.reason + "; " + judgement.manoeuvre;
}

std::string utc_text(std::int64_t utc_ns) { return utc_ns == 0 ? "an unknown time" : base::utc_text(utc_ns); }

std::string words_of(const FieldStep& step) {
  if (step.is_place)
    return step.returned ? "the field is that of the place before"
                         : "the field is that of another place: what was accepted before holds while it makes the "
                           "field here even";
  const auto& size = step.size_uT;
  const auto& error = step.std_uT;
  // Else all that is known is that the fits before and after differ.
  const bool is_clear = (size.array().abs() > 1.96 * error.array()).any();
  std::array<char, 200> text{};
  std::snprintf(text.data(), text.size(), "the field %s by (%.2f, %.2f, %.2f) +- (%.2f, %.2f, %.2f) uT at ",
                is_clear ? "stepped" : "may have stepped", size.x(), size.y(), size.z(), error.x(), error.y(),
                error.z());
  return text.data() + utc_text(step.utc_ns) + (step.returned ? ", back to the field before" : "");
}

const Quantity* CalibratorReport::quantity(std::string_view name) const {
  const auto found =
      std::find_if(estimate.begin(), estimate.end(), [&](const Quantity& q) { return q.name == name; });
  return found == estimate.end() ? nullptr : &*found;
}

const CalibratorReport* Report::find(Calibrator calibrator) const {
  const auto found = std::ranges::find(calibrators, calibrator, &CalibratorReport::calibrator);
  return found == calibrators.end() ? nullptr : &*found;
}

}  // namespace navcal::calib
