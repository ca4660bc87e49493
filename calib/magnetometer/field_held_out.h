// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "calib/archive.h"

namespace navcal::calib {

/// Every reading judged by the fit before it became part of it (Dawid, J. Royal Statistical Society A 147, 1984):
/// size of the field in uT, raw and calibrated, the latest readings counting most.
class FieldHeldOut {
 public:
  void update(double raw_size_uT, double departure_uT);
  [[nodiscard]] double before_uT() const;  ///< standard deviation of the raw size
  [[nodiscard]] double after_uT() const;   ///< root-mean-square of the calibrated size's departure from the fit's
  [[nodiscard]] double weight() const { return weight_; }
  void archive(Archive& archive) { archive(weight_, raw_, raw_square_, square_); }

 private:
  double weight_ = 0, raw_ = 0, raw_square_ = 0, square_ = 0;
};

}  // namespace navcal::calib
