// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "calib/gps/gps_track.h"
#include "calib/readings.h"
#include "tests/calib/thesis_paths.h"

namespace navcal::calib::test {

/// Columns of THESIS 11.5.
struct GpsNoise {
  double interval_s = 1;
  double velocity_std_m_s = 0;  ///< each axis
  double position_std_m = 0;    ///< each axis
  double heading_std_rad = 0;
  Eigen::Vector2d current_m_s = Eigen::Vector2d::Zero();
};
inline constexpr double kGpsOffset_rad = 3 * 0.017453292519943295;  ///< A of 11.5
[[nodiscard]] Deviation gps_deviation();                            ///< the thesis's, with that A

/// A path with compass, gyro, log and GPS carried along it.
struct GpsRun {
  std::vector<WaterTrackReading> track;
  std::vector<GroundReading> ground;
};
/// The water's motion is added to the path's.
[[nodiscard]] GpsRun measure_by_gps(const std::vector<TruePoint>& path, const Deviation& deviation,
                                    const GpsNoise& noise, Random& random);

/// In the order of times, from row `first` of the track to before row `end`.
template <class Estimator>
void feed(Estimator& estimator, const GpsRun& run, std::size_t first, std::size_t end) {
  std::size_t g = 0;
  while (first > 0 && g < run.ground.size() && run.ground[g].time_s <= run.track[first - 1].time_s) ++g;
  for (std::size_t k = first; k < end && k < run.track.size(); ++k) {
    for (; g < run.ground.size() && run.ground[g].time_s <= run.track[k].time_s; ++g)
      estimator.update(run.ground[g]);
    estimator.update(run.track[k]);
  }
}
template <class Estimator>
void feed(Estimator& estimator, const GpsRun& run) {
  feed(estimator, run, 0, run.track.size());
}

/// Greatest of |f'(found - truth)| over the circle, rad.
[[nodiscard]] double worst_residual_rad(const Deviation& found, const Deviation& truth);

}  // namespace navcal::calib::test
