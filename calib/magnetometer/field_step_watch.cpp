// SPDX-License-Identifier: Apache-2.0
#include "calib/magnetometer/field_step_watch.h"

#include <algorithm>

namespace navcal::calib {

bool FieldStepWatch::update(double z) {
  sum_ += std::min(z, kCeiling) - kReference;
  if (!(sum_ > 0)) {
    reset();
    return false;
  }
  ++since_onset_;
  if (since_onset_ > kLongest) {
    reset();
    return false;
  }
  return sum_ > kAlarm;
}

void FieldStepWatch::reset() {
  sum_ = 0;
  since_onset_ = 0;
}

}  // namespace navcal::calib
