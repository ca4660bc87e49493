#include <limits>

#include "calib/magnetometer.h"

namespace navcal::calib {

Magnetometer::Method Magnetometer::method() const {
  Method best = Method::none;
  double least = std::numeric_limits<double>::infinity();
  const auto consider = [&](Method method, const auto& estimator) {
    const auto estimate = estimator.estimate();
    if (!estimate || !(estimate->heading_std_rad < least) || !estimator.judgement().accepted) return;
    least = estimate->heading_std_rad;
    best = method;
  };
  // The ellipsoid first: it alone knows the vertical offset, without which every tilt is an error of heading.
  consider(Method::ellipsoid, now_.ellipsoid);
  if (best != Method::none) return best;
  consider(Method::ellipse, now_.ellipse);
  consider(Method::gyro_aided, now_.gyro);
  return best;
}

std::optional<MagnetometerEstimate> Magnetometer::estimate() const {
  switch (method()) {
    case Method::ellipsoid:
      return now_.ellipsoid.estimate();
    case Method::gyro_aided:
      return now_.gyro.estimate();
    case Method::ellipse:
    case Method::none:
      break;
  }
  return now_.ellipse.estimate();
}

Judgement Magnetometer::judgement() const {
  switch (method()) {
    case Method::ellipsoid:
      return now_.ellipsoid.judgement();
    case Method::gyro_aided:
      return now_.gyro.judgement();
    case Method::ellipse:
    case Method::none:
      break;
  }
  return now_.ellipse.judgement();
}

}  // namespace navcal::calib
