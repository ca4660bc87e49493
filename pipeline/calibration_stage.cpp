// SPDX-License-Identifier: Apache-2.0
#include "pipeline/calibration_stage.h"

#include <cmath>
#include <variant>

#include "base/enum_name.h"
#include "base/local_plane.h"
#include "pipeline/calibration_options.h"
#include "pipeline/readings.h"

namespace navcal::pipeline {
namespace {

using calib::Calibrator;
using protocols::Protocol;

/// A motor current older than this is not used. The motor's field cannot be told then.
constexpr std::int64_t kCurrentValid_ns = 1'000'000'000;

}  // namespace

std::string_view name_of(CalibrationChange::Cause cause) {
  return base::enum_name<CalibrationChange::Cause::start>(
      cause, {"begin", "automatic", "accept", "force", "rollback", "start"});
}

std::unique_ptr<CalibrationStage> CalibrationStage::make(const config::Settings& settings) {
  if (!settings.calibration.enabled) return nullptr;
  const CalibratedPorts ports = calibrated_ports(settings);
  if (!ports.compass) return nullptr;
  return std::make_unique<CalibrationStage>(settings, ports);
}

CalibrationStage::CalibrationStage(const config::Settings& settings, const CalibratedPorts& ports)
    : suite_(suite_options(settings, ports), ports.instruments()), ports_(ports),
      compass_delay_ns_(std::llround(settings.calibration.compass_delay_s * 1e9)) {
  for (const auto& port : settings.ports) protocols_.push_back(port.protocol);
}

void CalibrationStage::use(const EarthFieldWatch& field) {
  suite_.set_local_field(local_field(field.field()));
  field_place_ = field.place();
}

double CalibrationStage::seconds(std::int64_t validity_ns) {
  if (!origin_ns_) origin_ns_ = validity_ns;
  return static_cast<double>(validity_ns - *origin_ns_) * 1e-9;
}

std::optional<instruments::Sample> CalibrationStage::correct(instruments::Sample& sample) const {
  const auto& correction = suite_.in_force().correction();
  const auto name = suite_.in_force().name();
  sample.calibration = {name.number, name.sum};
  if (auto* compass = std::get_if<instruments::CompassSample>(&sample.value)) {
    if (sample.port != ports_.compass) return {};
    if (compass->heading_is_true) {
      // Whether what is in force makes headings, by a reading that has all that it may take.
      const calib::CompassReading any{
          .heading_rad = 0, .pitch_rad = 0, .roll_rad = 0, .field_body_uT = Eigen::Vector3d::UnitX()};
      if (protocols_.at(sample.port) != Protocol::mavlink || !calib::corrected_heading(correction, any)) return {};
      instruments::Sample heading = sample;
      heading.value =
          instruments::ScalarSample{instruments::Text<24>("autopilot_heading"), instruments::Text<16>("rad"),
                                    compass->heading_rad.value_or(NAN), compass->heading_std_rad};
      compass->heading_rad = compass->heading_std_rad = std::nullopt;
      compass->heading_is_true = false;
      return heading;
    }
    const bool fresh = motor_current_A_ && sample.stamp.validity_ns - motor_current_ns_ < kCurrentValid_ns;
    const auto reading = calib::without_motor_field(correction, calib_reading(*compass, sample.stamp, 0),
                                                    fresh ? motor_current_A_ : std::nullopt);
    compass->heading_calibrated_rad = calib::corrected_heading(correction, reading);
    const auto delay_ns = compass_delay_ns_ + std::llround(correction.compass_delay_s.value_or(0) * 1e9);
    sample.stamp.validity_ns -= delay_ns;
    sample.stamp.validity_utc_ns -= delay_ns;
  } else if (auto* imu = std::get_if<instruments::ImuSample>(&sample.value)) {
    if (sample.port != ports_.imu) return {};
    if (correction.gyro && imu->rate_rad_s)
      imu->yaw_rate_calibrated_rad_s = (*correction.gyro)((*imu->rate_rad_s)[2]);
    if (correction.gyro_b && imu->yaw_rate_b_rad_s)
      imu->yaw_rate_b_calibrated_rad_s = (*correction.gyro_b)(*imu->yaw_rate_b_rad_s);
  }
  return {};
}

void CalibrationStage::learn(const instruments::Sample& original, Sink& sink) {
  newest_ns_ = original.stamp.arrival_ns;
  std::visit([&](const auto& value) { learn_from(original, value); }, original.value);
  tell_adopted(sink);
}

void CalibrationStage::learn_from(const instruments::Sample& sample, const instruments::CompassSample& compass) {
  if (sample.port == ports_.reference) {
    if (const auto reference = reference_reading(compass, sample.stamp, seconds(sample.stamp.validity_ns)))
      suite_.put(*reference);
  }
  if (sample.port == ports_.compass && (is_reading_of_compass(compass) || compass.error)) {
    instruments::Stamp stamp = sample.stamp;
    stamp.validity_ns -= compass_delay_ns_;
    stamp.validity_utc_ns -= compass_delay_ns_;
    suite_.put(calib_reading(compass, stamp, seconds(stamp.validity_ns)));
  }
}

void CalibrationStage::learn_from(const instruments::Sample& sample, const instruments::ImuSample& imu) {
  if (sample.port != ports_.imu) return;
  if (const auto reading = calib_reading(imu, sample.stamp, seconds(sample.stamp.validity_ns)))
    suite_.put(*reading);
}

void CalibrationStage::learn_from(const instruments::Sample& sample, const instruments::GpsSample& gps) {
  if (sample.port != ports_.gps || !has_position(gps) || !gps.speed_m_s) return;
  if (!origin_latitude_rad_) {
    origin_latitude_rad_ = gps.latitude_rad;
    origin_longitude_rad_ = gps.longitude_rad;
  }
  calib::GroundReading reading;
  reading.time_s = seconds(sample.stamp.validity_ns);
  const base::LocalPlane plane(*origin_latitude_rad_, *origin_longitude_rad_);
  const auto [north_m, east_m] = plane.position_m(*gps.latitude_rad, *gps.longitude_rad);
  reading.position_m = {north_m, east_m};
  reading.speed_m_s = *gps.speed_m_s;
  reading.course_rad = gps.course_rad;
  suite_.put(reading);
}

void CalibrationStage::learn_from(const instruments::Sample& sample, const instruments::MotorSample& motor) {
  if (sample.port != ports_.motor) return;
  if (motor.current_A) {
    motor_current_A_ = *motor.current_A;
    motor_current_ns_ = sample.stamp.validity_ns;
  }
  if (motor.rpm || motor.current_A)
    suite_.put(calib::MotorReading{seconds(sample.stamp.validity_ns), motor.rpm, motor.current_A});
}

std::string CalibrationStage::order(CalibrationOrder order, Calibrator calibrator, std::int64_t now_ns,
                                    Sink& sink) {
  using Cause = CalibrationChange::Cause;
  switch (order) {
    case CalibrationOrder::accept:
      if (auto why_not = suite_.accept(calibrator); !why_not.empty()) return why_not;
      tell(now_ns, Cause::accept, calibrator, sink);
      break;
    case CalibrationOrder::force:
      if (auto why_not = suite_.accept(calibrator, true); !why_not.empty()) return why_not;
      tell(now_ns, Cause::force, calibrator, sink);
      break;
    case CalibrationOrder::roll_back:
      if (auto why_not = suite_.roll_back(calibrator); !why_not.empty()) return why_not;
      tell(now_ns, Cause::roll_back, calibrator, sink);
      break;
    case CalibrationOrder::start:
      if (auto why_not = suite_.start(calibrator); !why_not.empty()) return why_not;
      tell(now_ns, Cause::start, calibrator, sink);
      break;
  }
  return {};
}

void CalibrationStage::finish(Sink& sink) {
  suite_.finish();
  tell_adopted(sink);
}

void CalibrationStage::tell_adopted(Sink& sink) {
  while (const auto adopted = suite_.take_adopted()) {
    tell(newest_ns_, CalibrationChange::Cause::automatic, *adopted, sink);
  }
  if (const auto step = suite_.take_field_step()) sink.on_field_step(*step, newest_ns_);
}

void CalibrationStage::tell(std::int64_t now_ns, CalibrationChange::Cause cause, Calibrator calibrator,
                            Sink& sink) const {
  const auto& in_force = suite_.in_force();
  sink.on_calibration({now_ns, cause, calibrator, in_force.name(), in_force.correction(), {}});
}

CalibrationChange CalibrationStage::beginning(std::int64_t now_ns) {
  // Twice what a state takes. Pages that nothing is written to take no memory.
  constexpr std::size_t kRoom_bytes = 1 << 20;
  calib::Archive saving(kRoom_bytes);
  archive(saving);
  const auto& in_force = suite_.in_force();
  return {now_ns,          CalibrationChange::Cause::begin, std::nullopt,
          in_force.name(), in_force.correction(),           std::move(saving).take()};
}

bool CalibrationStage::restore(std::string_view state) {
  calib::Archive before;
  archive(before);
  calib::Archive restoring(state);
  archive(restoring);
  if (restoring.ok() && restoring.at_end()) return true;
  // Half of a damaged state is worse than none.
  calib::Archive back(before.bytes());
  archive(back);
  return false;
}

void CalibrationStage::begin_run() {
  suite_.restart();
  origin_ns_.reset();
  motor_current_A_.reset();
}

void CalibrationStage::archive(calib::Archive& archive) {
  const bool has_reference =
      archive.tag_either("calibration_stage 3", "calibration_stage 4", ports_.reference.has_value());
  archive(suite_, newest_ns_, origin_ns_, origin_latitude_rad_, origin_longitude_rad_, motor_current_A_,
          motor_current_ns_, field_place_, ports_.compass, ports_.imu, ports_.gps, ports_.motor);
  if (has_reference) {
    archive(ports_.reference);
  } else {
    ports_.reference.reset();
  }
}

}  // namespace navcal::pipeline
