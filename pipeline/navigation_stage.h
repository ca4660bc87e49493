// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "base/local_plane.h"
#include "config/settings.h"
#include "devices/instrument_model.h"
#include "instruments/samples.h"
#include "nav/altitude_filter.h"
#include "nav/navigator.h"
#include "pipeline/calibration_options.h"
#include "pipeline/floor_watch.h"
#include "pipeline/navigation.h"
#include "pipeline/pipeline.h"
#include "pipeline/sources.h"
#include "pipeline/surfacing.h"

namespace navcal::pipeline {

/// Between samples and the estimator of position: picks the instruments, feeds them, and tells the sink at the
/// interval of the configuration. Two estimators run side by side, one with the calibration in force and one
/// without any, so that every stretch without fixes shows what the calibration is worth.
class NavigationStage {
 public:
  /// Null when the configuration says not to, or has nothing to navigate by.
  static std::unique_ptr<NavigationStage> make(const config::Settings& settings);
  explicit NavigationStage(const config::Settings& settings);

  /// `original` as it was before the calibration in force was put on it; `tilt` by the accelerometers, where there
  /// are any. The sink must have had the sample.
  void take(const instruments::Sample& original, const instruments::Sample& corrected,
            const std::optional<nav::TiltReading>& tilt, const UtcMapping& mapping, Sink& sink);
  /// The sample of a receiver whose antenna is not at the vehicle's origin, with position and velocity of the
  /// origin; nullopt where it stays as it is. The arm is turned by the attitude of the time of the fix. A
  /// receiver's velocity is a mean over about the second before, and so is that of the arm.
  [[nodiscard]] std::optional<instruments::Sample> at_origin(const instruments::Sample& sample) const;
  /// The estimate as it is now, without an outage; its stamp has no arrival. Nullopt before anything came.
  [[nodiscard]] std::optional<NavigationSample> newest(const UtcMapping& mapping) const;
  /// Everything begins anew.
  void begin_run();
  /// Other ports serve from here on.
  void use(const RolePorts& ports) { ports_ = ports; }
  /// From here on.
  void set_declination(double declination_rad);

 private:
  void feed(nav::Navigator& navigator, const instruments::Sample& sample,
            const instruments::CompassSample& compass, bool calibrated) const;
  void feed(nav::Navigator& navigator, const instruments::Sample& sample, const instruments::ImuSample& imu,
            bool calibrated);
  void feed_tilt(const nav::TiltReading& tilt);
  void feed_fix(const instruments::Sample& sample, const instruments::GpsSample& gps);
  void feed_dvl(const instruments::Sample& sample, const instruments::DvlSample& dvl, Sink& sink);
  void feed_depth(const instruments::Sample& sample, const instruments::DepthSample& gauge);
  void feed_altitude(const instruments::Sample& sample, const instruments::AltimeterSample& altimeter, Sink& sink);
  /// `range_m` along the z axis of a body with this tilt.
  void feed_altitude(const instruments::Sample& sample, double range_m, double pitch_rad, double roll_rad,
                     Sink& sink);
  void tell(const instruments::Sample& trigger, const UtcMapping& mapping, Sink& sink);

  config::NavigationSettings settings_;
  std::vector<bool> tilt_lags_;  ///< of each port
  RolePorts ports_;
  nav::Options options_;
  double declination_rad_;
  bool heading_was_true_ = false;  ///< the newest one, by the device itself
  devices::GpsModel gps_;
  double max_error_m_;
  std::int64_t interval_ns_;
  nav::Navigator calibrated_, uncalibrated_;
  std::optional<base::LocalPlane> plane_;
  std::optional<std::int64_t> dvl_ns_;                          ///< newest sample of the DVL that serves
  std::optional<std::int64_t> inclinometer_ns_;                 ///< newest tilt of the compass
  std::vector<Eigen::Vector3d> positions_m_;                    ///< of each port's sensor
  std::optional<double> depth_m_, depth_std_m_;                 ///< newest that is not used yet
  Eigen::Vector3d depth_position_m_ = Eigen::Vector3d::Zero();  ///< of its gauge
  std::optional<Eigen::Vector2d> velocity_m_s_;                 ///< newest that is not used yet
  double velocity_std_m_s_ = 0;                                 ///< of velocity_m_s_, each axis
  std::int64_t velocity_ns_ = 0;
  SurfacingWatch surfacings_;
  std::optional<Surfacing> surfacing_;  ///< not told yet
  SurfaceNewsWatch surface_news_;
  nav::AltitudeFilter altitude_;
  FloorWatch floor_;
  std::int64_t told_ = 0;  ///< intervals of the monotonic clock, up to the one that was last told of
};

/// Configuration of the estimator, in its units.
[[nodiscard]] nav::Options navigation_options(const config::Settings& settings);
[[nodiscard]] nav::AltitudeOptions altitude_options(const config::NavigationSettings& settings);

}  // namespace navcal::pipeline
