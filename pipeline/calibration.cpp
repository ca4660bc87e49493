// SPDX-License-Identifier: Apache-2.0
#include "pipeline/calibration.h"

#include "base/enum_name.h"

namespace navcal::pipeline {

std::string_view name_of(CalibrationChange::Cause cause) {
  return base::enum_name<CalibrationChange::Cause::start>(
      cause, {"begin", "automatic", "accept", "force", "rollback", "start"});
}

}  // namespace navcal::pipeline
