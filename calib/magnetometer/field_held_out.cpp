// SPDX-License-Identifier: Apache-2.0
#include "calib/magnetometer/field_held_out.h"

#include <algorithm>
#include <cmath>

namespace navcal::calib {

void FieldHeldOut::update(double raw_size_uT, double departure_uT) {
  constexpr double kMemory = 300;  // readings
  weight_ = std::min(weight_ + 1, kMemory);
  const double gain = 1 / weight_;
  raw_ += gain * (raw_size_uT - raw_);
  raw_square_ += gain * (raw_size_uT * raw_size_uT - raw_square_);
  square_ += gain * (departure_uT * departure_uT - square_);
}

double FieldHeldOut::before_uT() const { return std::sqrt(std::max(0.0, raw_square_ - raw_ * raw_)); }

double FieldHeldOut::after_uT() const { return std::sqrt(square_); }

}  // namespace navcal::calib
