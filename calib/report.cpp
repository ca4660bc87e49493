#include "calib/report.h"

#include <algorithm>

namespace navcal::calib {

std::string_view name_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::shadow:
      return "shadow";
    case Verdict::in_force:
      return "in_force";
    case Verdict::refused:
      break;
  }
  return "refused";
}

std::string_view name_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::accepted:
      return "accepted";
    case Outcome::no_better:
      return "no better";
    case Outcome::refused:
      break;
  }
  return "refused";
}

const Quantity* CalibratorReport::quantity(std::string_view name) const {
  const auto found =
      std::find_if(estimate.begin(), estimate.end(), [&](const Quantity& q) { return q.name == name; });
  return found == estimate.end() ? nullptr : &*found;
}

const CalibratorReport* Report::find(Calibrator calibrator) const {
  const auto found = std::find_if(calibrators.begin(), calibrators.end(),
                                  [&](const CalibratorReport& report) { return report.calibrator == calibrator; });
  return found == calibrators.end() ? nullptr : &*found;
}

}  // namespace navcal::calib
