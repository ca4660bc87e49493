// SPDX-License-Identifier: Apache-2.0
#include <limits>

#include "calib/magnetometer/magnetometer.h"

namespace navcal::calib {

const Magnetometer::Answer& Magnetometer::answer() const {
  if (!answer_) answer_ = chosen();
  return *answer_;
}

Magnetometer::Answer Magnetometer::chosen() const {
  Answer best;
  double least = std::numeric_limits<double>::infinity();  // of those that accept; of all while none does
  const auto consider = [&](Method method, const auto& estimator) {
    auto estimate = estimator.estimate();
    if (!estimate) return;
    auto judgement = estimator.judgement();
    const bool accepted = best.method != Method::none;
    const bool better = estimate->heading_std_rad < least;
    if (judgement.accepted ? accepted && !better : accepted || !better) return;
    least = estimate->heading_std_rad;
    best = {judgement.accepted ? method : Method::none, std::move(estimate), std::move(judgement)};
  };
  // The ellipsoid comes first because it alone determines the vertical offset. Without that, every tilt causes
  // an error of heading.
  consider(Method::ellipsoid, now_.ellipsoid);
  if (best.method != Method::none) return best;
  consider(Method::ellipse, now_.ellipse);
  consider(Method::gyro_aided, now_.gyro);
  if (!best.estimate) best.judgement = now_.ellipse.judgement();
  // Where the hull does not stay level, what the level fits miss is not what stands against them.
  constexpr double kLevel_rad = 0.17;
  if (best.method == Method::none && now_.ellipsoid.fit() && now_.ellipsoid.tilt_seen_rad() > kLevel_rad)
    best = {Method::none, now_.ellipsoid.estimate(), now_.ellipsoid.judgement()};
  return best;
}

}  // namespace navcal::calib
