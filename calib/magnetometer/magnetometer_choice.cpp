// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <limits>
#include <utility>

#include "calib/magnetometer/magnetometer.h"

namespace navcal::calib {

const Magnetometer::Answer& Magnetometer::answer() const {
  if (answer_) return *answer_;
  answer_ = chosen(now_);
  if (!is_elsewhere_ || !has_same_iron()) return *answer_;
  Answer there = chosen(*before_);
  const bool is_worse = answer_->method == Method::none ||
                        (there.estimate && there.estimate->heading_std_rad < answer_->estimate->heading_std_rad);
  if (there.method != Method::none && is_worse) answer_ = std::move(there);
  return *answer_;
}

double Magnetometer::scatter_of_size(const FieldCorrection& correction) const {
  const SizeSpread size = spread_of(now_.ellipsoid.cells(), correction.matrix, correction.offset_uT);
  return size.mean > 0 ? size.std / size.mean : 0;
}

bool Magnetometer::has_same_iron() const {
  // Scatter that a place has anyway, and the share of the raw one that may be left.
  constexpr double kEven = 0.02, kShareLeft = 0.7;
  const EllipsoidShape& shape = before_->predictor.shape();
  return scatter_of_size({shape.centre_uT, shape.matrix_per_uT}) <=
         std::max(kEven, kShareLeft * scatter_of_size({}));
}

Magnetometer::Answer Magnetometer::chosen(const Estimators& of) {
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
  consider(Method::ellipsoid, of.ellipsoid);
  if (best.method != Method::none) return best;
  consider(Method::ellipse, of.ellipse);
  consider(Method::gyro_aided, of.gyro);
  if (!best.estimate) best.judgement = of.ellipse.judgement();
  // Where the hull does not stay level, what the level fits miss is not what stands against them.
  constexpr double kLevel_rad = 0.17;
  if (best.method == Method::none && of.ellipsoid.fit() && of.ellipsoid.tilt_seen_rad() > kLevel_rad)
    best = {Method::none, of.ellipsoid.estimate(), of.ellipsoid.judgement()};
  return best;
}

}  // namespace navcal::calib
