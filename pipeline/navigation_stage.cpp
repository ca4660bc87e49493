// SPDX-License-Identifier: Apache-2.0
#include "pipeline/navigation_stage.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "base/angles.h"
#include "base/durations.h"
#include "base/rotation.h"
#include "devices/instrument_model.h"
#include "instruments/compass_error.h"
#include "pipeline/readings.h"

namespace navcal::pipeline {
namespace {

/// Fixes come once a second and half a second late.
constexpr double kFixIsCurrent_s = 2.5;
/// After such a pause of the inclinometer the accelerometers hold roll and pitch.
constexpr std::int64_t kInclinometerPause_ns = 2'000'000'000;
/// The velocity of another receiver is that of a fix when it lies no further from it.
constexpr std::int64_t kVelocityAge_ns = 600'000'000;
/// A DVL that is silent for longer is not heard any more.
constexpr std::int64_t kDvlPause_ns = 3'000'000'000;

/// An inclinometer is a fluid and lags. A device that measures rates as well carries its tilt by them.
std::vector<bool> tilt_lags_of(const config::Settings& settings) {
  std::vector<bool> lags;
  for (const auto& port : settings.ports) lags.push_back(!config::can_deliver(port.protocol, Role::rates));
  return lags;
}

}  // namespace

nav::Options navigation_options(const config::Settings& settings) {
  const devices::InstrumentModel instruments = devices::instrument_model(settings);
  nav::Options options;
  options.attitude.tilt_lag_s = instruments.compass.tilt_lag_s;
  options.reckoning.set_m_s = settings.calibration.current_m_s;
  options.reckoning.speed_error = settings.navigation.speed_error;
  options.velocity.scale_error = settings.navigation.dvl_scale_error;
  options.velocity.alignment_error_rad = settings.navigation.dvl_alignment_error_rad;
  options.advance_m = settings.calibration.advance_m;
  options.speed_lag_s = settings.navigation.speed_lag_s;
  options.heading_error_rad = settings.navigation.heading_error_rad;
  options.heading_error_calibrated_rad = settings.navigation.heading_error_calibrated_rad;
  return options;
}

nav::AltitudeOptions altitude_options(const config::NavigationSettings& settings) {
  nav::AltitudeOptions options;
  options.noise_m = settings.altitude_noise_m;
  options.range_m = settings.altimeter_range_m;
  return options;
}

std::unique_ptr<NavigationStage> NavigationStage::make(const config::Settings& settings) {
  const auto has = [&](Role role) { return !candidates(settings, role).empty(); };
  const bool something = has(Role::heading) || has(Role::rates) || has(Role::position);
  if (!settings.navigation.enabled || !something) return nullptr;
  return std::make_unique<NavigationStage>(settings);
}

NavigationStage::NavigationStage(const config::Settings& settings)
    : settings_(settings.navigation), tilt_lags_(tilt_lags_of(settings)), ports_(Sources(settings).serving()),
      options_(navigation_options(settings)), declination_rad_(settings.environment.declination_rad),
      gps_(devices::instrument_model(settings).gps), max_error_m_(settings.navigation.max_error_m),
      interval_ns_(std::llround(settings.navigation.interval_s * 1e9)), calibrated_(options_),
      uncalibrated_(options_), positions_m_(mounted_positions_m(settings)), surfacings_(gps_.antenna_depth_m),
      altitude_(altitude_options(settings.navigation)), floor_(settings.navigation) {}

void NavigationStage::begin_run() {
  calibrated_ = uncalibrated_ = nav::Navigator(options_);
  plane_.reset();
  dvl_ns_.reset();
  inclinometer_ns_.reset();
  depth_m_.reset();
  velocity_m_s_.reset();
  surfacings_ = SurfacingWatch(gps_.antenna_depth_m);
  surfacing_.reset();
  surface_news_ = {};
  altitude_ = nav::AltitudeFilter(altitude_.options());
  told_ = 0;
}

void NavigationStage::set_declination(double declination_rad) {
  if (!heading_was_true_) {
    for (nav::Navigator* navigator : {&calibrated_, &uncalibrated_})
      navigator->turn_north(declination_rad - declination_rad_);
  }
  declination_rad_ = declination_rad;
}

void NavigationStage::take(const instruments::Sample& original, const instruments::Sample& corrected,
                           const std::optional<nav::TiltReading>& tilt, const UtcMapping& mapping, Sink& sink) {
  if (const auto* compass = std::get_if<instruments::CompassSample>(&corrected.value)) {
    if (corrected.port != ports_[Role::heading]) return;
    const bool shows_tilt = compass->pitch_rad && compass->roll_rad && !compass->tilt_by_accelerometers;
    if (compass->heading_rad || compass->heading_calibrated_rad) heading_was_true_ = compass->heading_is_true;
    if (shows_tilt) inclinometer_ns_ = corrected.stamp.validity_ns;
    feed(calibrated_, corrected, *compass, true);
    feed(uncalibrated_, original, std::get<instruments::CompassSample>(original.value), false);
  } else if (const auto* imu = std::get_if<instruments::ImuSample>(&corrected.value)) {
    if (corrected.port == ports_[Role::depth] && imu->depth_m) {
      depth_m_ = imu->depth_m;
      depth_std_m_ = imu->depth_std_m;
      depth_position_m_ = positions_m_.at(corrected.port);
      surfacings_.depth(corrected.stamp.validity_ns, *imu->depth_m);
    }
    if (corrected.port != ports_[Role::rates] || !imu->rate_rad_s) return;
    feed(calibrated_, corrected, *imu, true);
    feed(uncalibrated_, original, std::get<instruments::ImuSample>(original.value), false);
    depth_m_.reset();
    if (tilt) feed_tilt(*tilt);
  } else if (const auto* motor = std::get_if<instruments::MotorSample>(&corrected.value)) {
    const auto reading = shaft_reading(corrected, *motor);
    if (corrected.port != ports_[Role::shaft] || !reading) return;
    calibrated_.take(*reading);
    uncalibrated_.take(*reading);
  } else if (const auto* gps = std::get_if<instruments::GpsSample>(&corrected.value)) {
    const auto velocity_m_s = ground_velocity_m_s(*gps);
    if (corrected.port == ports_[Role::velocity] && velocity_m_s) {
      velocity_m_s_ = velocity_m_s;
      velocity_std_m_s_ = gps->velocity_std_m_s.value_or(gps_.velocity_noise_m_s);
      velocity_ns_ = corrected.stamp.validity_ns;
    }
    if (corrected.port != ports_[Role::position]) return;
    feed_fix(corrected, *gps);
  } else if (const auto* altimeter = std::get_if<instruments::AltimeterSample>(&corrected.value)) {
    if (corrected.port == ports_[Role::altitude]) feed_altitude(corrected, *altimeter, sink);
  } else if (const auto* dvl = std::get_if<instruments::DvlSample>(&corrected.value)) {
    feed_dvl(corrected, *dvl, sink);
  } else if (const auto* gauge = std::get_if<instruments::DepthSample>(&corrected.value)) {
    if (corrected.port == ports_[Role::depth]) feed_depth(corrected, *gauge);
  }
  tell(corrected, mapping, sink);
}

void NavigationStage::feed(nav::Navigator& navigator, const instruments::Sample& sample,
                           const instruments::CompassSample& compass, bool calibrated) const {
  if (instruments::CompassError(compass.error).unknown) return;
  nav::CompassReading reading;
  reading.time_ns = sample.stamp.validity_ns;
  reading.calibrated = calibrated && compass.heading_calibrated_rad;
  reading.heading_rad = reading.calibrated ? compass.heading_calibrated_rad : compass.heading_rad;
  reading.heading_std_rad = compass.heading_std_rad.value_or(0);
  if (reading.heading_rad && !compass.heading_is_true) *reading.heading_rad += declination_rad_;
  if (!compass.tilt_by_accelerometers) {
    reading.pitch_rad = compass.pitch_rad;
    reading.roll_rad = compass.roll_rad;
    reading.tilt_lags = tilt_lags_.at(sample.port);
  }
  navigator.take(reading);
}

void NavigationStage::feed(nav::Navigator& navigator, const instruments::Sample& sample,
                           const instruments::ImuSample& imu, bool calibrated) {
  auto reading = rate_reading(sample, imu);
  if (!reading) return;
  if (calibrated && imu.yaw_rate_calibrated_rad_s) reading->rate_rad_s.z() = *imu.yaw_rate_calibrated_rad_s;
  reading->depth_m = depth_m_;
  reading->depth_std_m = depth_std_m_;
  reading->depth_position_m = depth_position_m_;
  navigator.take(*reading);
}

/// While an inclinometer shows the tilt, the accelerometers are not needed.
void NavigationStage::feed_tilt(const nav::TiltReading& tilt) {
  if (inclinometer_ns_ && tilt.time_ns - *inclinometer_ns_ <= kInclinometerPause_ns) return;
  calibrated_.take(tilt);
  uncalibrated_.take(tilt);
}

void NavigationStage::feed_fix(const instruments::Sample& sample, const instruments::GpsSample& gps) {
  if (!has_position(gps)) return;
  if (const auto surfacing = surfacings_.fix(sample.stamp.validity_ns, gps)) surfacing_ = surfacing;
  if (!plane_) plane_.emplace(*gps.latitude_rad, *gps.longitude_rad);
  const auto [north_m, east_m] = plane_->position_m(*gps.latitude_rad, *gps.longitude_rad);
  nav::FixReading reading;
  reading.time_ns = sample.stamp.validity_ns;
  reading.position_m = {north_m, east_m};
  const bool fits = std::abs(sample.stamp.validity_ns - velocity_ns_) <= kVelocityAge_ns;
  if (velocity_m_s_ && fits) {
    reading.velocity_m_s = velocity_m_s_;
    reading.velocity_std_m_s = velocity_std_m_s_;
  }
  velocity_m_s_.reset();
  reading.std_m = gps.position_std_m.value_or(gps_.position_noise_m);
  // Without an attitude the antenna is anywhere around the origin.
  if (const auto& arm_m = positions_m_.at(sample.port);
      !arm_m.isZero(0) && !calibrated_.attitude_at(reading.time_ns))
    reading.std_m = std::hypot(reading.std_m, arm_m.norm());
  calibrated_.take(reading);
  uncalibrated_.take(reading);
}

std::optional<instruments::Sample> NavigationStage::at_origin(const instruments::Sample& sample) const {
  const auto* gps = std::get_if<instruments::GpsSample>(&sample.value);
  const Eigen::Vector3d& position_m = positions_m_.at(sample.port);
  if (gps == nullptr || position_m.isZero(0)) return std::nullopt;
  const auto arm_m = [&](std::int64_t time_ns) -> std::optional<Eigen::Vector3d> {
    const auto pose = calibrated_.attitude_at(time_ns);
    if (!pose) return std::nullopt;
    return base::rotation_of({pose->roll_rad, pose->pitch_rad, pose->heading_rad}) * position_m;
  };
  const auto arm_now_m = arm_m(sample.stamp.validity_ns);
  if (!arm_now_m) return std::nullopt;
  instruments::Sample moved = sample;
  auto& fix = std::get<instruments::GpsSample>(moved.value);
  if (has_position(*gps)) {
    const auto place =
        base::LocalPlane(*gps->latitude_rad, *gps->longitude_rad).place(-arm_now_m->x(), -arm_now_m->y());
    fix.latitude_rad = place.latitude_rad;
    fix.longitude_rad = place.longitude_rad;
  }
  const auto arm_before_m = arm_m(sample.stamp.validity_ns - base::kSecond_ns);
  if (const auto velocity_m_s = ground_velocity_m_s(*gps); velocity_m_s && arm_before_m) {
    const Eigen::Vector2d origin_m_s = *velocity_m_s - (*arm_now_m - *arm_before_m).head<2>();
    fix.speed_m_s = origin_m_s.norm();
    fix.course_rad = base::positive_angle(std::atan2(origin_m_s.y(), origin_m_s.x()));
  }
  return moved;
}

void NavigationStage::feed_dvl(const instruments::Sample& sample, const instruments::DvlSample& dvl, Sink& sink) {
  const Eigen::Vector3d& position_m = positions_m_.at(sample.port);
  const bool over_bottom = sample.port == ports_[Role::bottom_velocity];
  const bool through_water = sample.port == ports_[Role::water_velocity];
  if (over_bottom || through_water) dvl_ns_ = sample.stamp.validity_ns;
  // The velocity over the bottom is compared with that through the water at the same time.
  if (const auto reading = water_reading(sample, dvl, position_m); reading && through_water) {
    calibrated_.take(*reading);
    uncalibrated_.take(*reading);
  }
  if (const auto reading = bottom_reading(sample, dvl, position_m); reading && over_bottom) {
    calibrated_.take(*reading);
    uncalibrated_.take(*reading);
  }
  if (dvl.altitude_m && sample.port == ports_[Role::altitude]) feed_altitude(sample, *dvl.altitude_m, 0, 0, sink);
}

void NavigationStage::feed_depth(const instruments::Sample& sample, const instruments::DepthSample& gauge) {
  const auto depth_now_m = depth_m(gauge, settings_);
  if (!depth_now_m) return;
  const nav::DepthReading reading{sample.stamp.validity_ns, *depth_now_m, positions_m_.at(sample.port),
                                  depth_std_m(gauge, settings_)};
  calibrated_.take(reading);
  uncalibrated_.take(reading);
  surfacings_.depth(sample.stamp.validity_ns, *depth_now_m);
}

void NavigationStage::feed_altitude(const instruments::Sample& sample,
                                    const instruments::AltimeterSample& altimeter, Sink& sink) {
  const nav::Estimate estimate = calibrated_.estimate();
  feed_altitude(sample, altimeter.altitude_m, estimate.pitch_rad.value_or(0), estimate.roll_rad.value_or(0), sink);
}

void NavigationStage::feed_altitude(const instruments::Sample& sample, double range_m, double pitch_rad,
                                    double roll_rad, Sink& sink) {
  const std::int64_t time_ns = sample.stamp.validity_ns;
  if (!altitude_.take(time_ns, range_m, pitch_rad, roll_rad)) return;
  const auto altitude = altitude_.at(time_ns);
  if (!altitude || !floor_.take(time_ns, *altitude)) return;
  sink.on_alarm({EstimateAlarm::floor_near, floor_.is_near(), sample.port, sample.stamp.arrival_ns,
                 fmt::format("{:.1f} m above the floor, {:+.2f} m/s", altitude->altitude_m, altitude->rate_m_s)});
}

void NavigationStage::tell(const instruments::Sample& trigger, const UtcMapping& mapping, Sink& sink) {
  if (!calibrated_.started()) return;
  const auto outage = calibrated_.take_outage();
  const auto uncalibrated_outage = uncalibrated_.take_outage();
  const std::int64_t interval = calibrated_.time_ns() / interval_ns_;
  if (interval <= told_ && !outage && !surfacing_) return;
  told_ = std::max(told_, interval);

  NavigationSample sample = *newest(mapping);
  sample.calibration = trigger.calibration;
  instruments::Stamp stamp = trigger.stamp;
  stamp.validity_ns = sample.stamp.validity_ns;
  stamp.validity_utc_ns = sample.stamp.validity_utc_ns;
  sample.stamp = stamp;
  sample.outage = outage;
  if (uncalibrated_outage) sample.outage_error_uncalibrated_m = uncalibrated_outage->error_m;
  sample.surfacing = std::exchange(surfacing_, std::nullopt);
  sample.max_error_m = max_error_m_;
  sample.advice = surface_advice(calibrated_, gps_, max_error_m_);
  sample.surface_news = surface_news_.take(sample.advice, sample.source == PositionSource::reckoned);
  sink.on_navigation(sample);
}

std::optional<NavigationSample> NavigationStage::newest(const UtcMapping& mapping) const {
  if (!calibrated_.started()) return std::nullopt;
  NavigationSample sample;
  sample.estimate = calibrated_.estimate();
  sample.stamp.validity_ns = sample.estimate.time_ns;
  sample.stamp.validity_utc_ns = mapping.to_utc(sample.estimate.time_ns);
  if (dvl_ns_ && sample.estimate.time_ns - *dvl_ns_ <= kDvlPause_ns)
    sample.bottom_lock = sample.estimate.speed_source == nav::SpeedSource::bottom;
  if (const auto altitude = altitude_.at(sample.estimate.time_ns)) {
    sample.altitude_m = altitude->altitude_m;
    sample.altitude_std_m = altitude->std_m;
    if (sample.estimate.depth_m) sample.water_depth_m = *sample.estimate.depth_m + altitude->altitude_m;
  }
  if (const auto& position_m = sample.estimate.position_m; position_m && plane_) {
    const auto place = plane_->place(position_m->x(), position_m->y());
    sample.latitude_rad = place.latitude_rad;
    sample.longitude_rad = place.longitude_rad;
    sample.source =
        sample.estimate.since_fix_s <= kFixIsCurrent_s ? PositionSource::fixes : PositionSource::reckoned;
  }
  return sample;
}

}  // namespace navcal::pipeline
