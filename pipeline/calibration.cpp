// SPDX-License-Identifier: Apache-2.0
#include "pipeline/calibration.h"

namespace navcal::pipeline {

std::string_view name_of(CalibrationChange::Cause cause) {
  switch (cause) {
    case CalibrationChange::Cause::begin: return "begin";
    case CalibrationChange::Cause::automatic: return "automatic";
    case CalibrationChange::Cause::accept: return "accept";
    case CalibrationChange::Cause::force: return "force";
    case CalibrationChange::Cause::roll_back: return "rollback";
    case CalibrationChange::Cause::start: break;
  }
  return "start";
}

}  // namespace navcal::pipeline
