// SPDX-License-Identifier: Apache-2.0
#include "instruments/compass_calibration.h"

#include <utility>

namespace navcal::instruments {

void CompassCalibration::begin(std::int64_t now_ns) {
  touched_ = may_calibrate_ = false;
  failure_.clear();
  forget_results();
  start_part(Part::calibrating, now_ns);
}

void CompassCalibration::stop(std::int64_t now_ns) {
  if (!busy() || part_ != Part::calibrating) return;
  fail(called_off());
  start_part(after_turning(), now_ns);
}

void CompassCalibration::abandon(std::string reason) {
  if (!busy()) return;
  if (figures().empty()) fail(std::move(reason));
  turning_ = false;
  end();
}

void CompassCalibration::start_part(Part part, std::int64_t when_ns) {
  part_ = part;
  turning_ = false;
  start_at(when_ns);
}

void CompassCalibration::fail(std::string reason) {
  if (failure_.empty()) failure_ = std::move(reason);
}

std::string CompassCalibration::state() const {
  if (busy()) return turning_ ? progress() : failure_.empty() ? doing_ : doing_ + "; failed: " + failure_;
  if (!failure_.empty()) return "failed: " + failure_;
  return figures().empty() ? "not begun" : result();
}

std::unique_ptr<CompassCalibration> make_compass_calibration(const config::PortSettings& settings,
                                                             std::int64_t longest_ns) {
  if (settings.protocol == protocols::Protocol::tcm2) return calibrate_tcm2(settings, longest_ns);
  if (settings.protocol == protocols::Protocol::pni) return calibrate_pni(longest_ns);
  return nullptr;
}

bool is_compass_calibration(std::string_view name) { return name == "tcm2" || name == "pni"; }

}  // namespace navcal::instruments
