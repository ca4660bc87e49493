// SPDX-License-Identifier: Apache-2.0
#include "api/sample_of.h"

#include <string>
#include <utility>
#include <variant>

#include "protocols/frame.h"

namespace navcal::api {
namespace {

Stamp stamp_of(const instruments::Stamp& stamp) {
  return {stamp.arrival_ns, stamp.validity_ns, stamp.std_ns, stamp.arrival_utc_ns, stamp.validity_utc_ns};
}

CalibrationName name_of_calibration(const instruments::CalibrationName& name) { return {name.number, name.sum}; }

Fix fix_of(instruments::Fix fix) {
  switch (fix) {
    case instruments::Fix::none: return Fix::none;
    case instruments::Fix::fix_2d: return Fix::fix_2d;
    case instruments::Fix::fix_3d: return Fix::fix_3d;
    case instruments::Fix::propagated: return Fix::propagated;
    case instruments::Fix::hold: return Fix::hold;
    case instruments::Fix::acquiring: return Fix::acquiring;
    case instruments::Fix::bad_geometry: return Fix::bad_geometry;
  }
  return Fix::none;
}

/// The public counterpart of each kind of sample.
struct MeasurementOf {
  using Result = std::optional<Measurement>;

  Result operator()(const instruments::CompassSample& s) const {
    return CompassSample{.heading_rad = s.heading_rad,
                         .heading_is_true = s.heading_is_true,
                         .heading_calibrated_rad = s.heading_calibrated_rad,
                         .pitch_rad = s.pitch_rad,
                         .roll_rad = s.roll_rad,
                         .tilt_by_accelerometers = s.tilt_by_accelerometers,
                         .field_body_uT = s.field_body_uT,
                         .dip_rad = s.dip_rad,
                         .turn_rate_rad_s = s.turn_rate_rad_s,
                         .temperature_C = s.temperature_C,
                         .error = s.error,
                         .heading_std_rad = s.heading_std_rad,
                         .tilt_std_rad = s.tilt_std_rad,
                         .field_std_uT = s.field_std_uT};
  }
  Result operator()(const instruments::ImuSample& s) const {
    ImuSample imu{.rate_rad_s = s.rate_rad_s,
                  .yaw_rate_b_rad_s = s.yaw_rate_b_rad_s,
                  .yaw_rate_calibrated_rad_s = s.yaw_rate_calibrated_rad_s,
                  .yaw_rate_b_calibrated_rad_s = s.yaw_rate_b_calibrated_rad_s,
                  .specific_force_m_s2 = s.specific_force_m_s2,
                  .depth_m = s.depth_m,
                  .temperature_C = s.temperature_C,
                  .over_range = s.over_range,
                  .card = {},
                  .rate_std_rad_s = s.rate_std_rad_s,
                  .specific_force_std_m_s2 = s.specific_force_std_m_s2,
                  .depth_std_m = s.depth_std_m};
    if (s.card) imu.card = CardState{s.card->sequence, s.card->leak_forward, s.card->leak_aft, s.card->low_supply};
    return imu;
  }
  Result operator()(const instruments::GpsSample& s) const {
    return GpsSample{.time_utc_ns = s.time_utc_ns,
                     .time_corrected = s.time_corrected,
                     .leap_known = s.leap_known,
                     .fix = fix_of(s.fix),
                     .latitude_rad = s.latitude_rad,
                     .longitude_rad = s.longitude_rad,
                     .height_m = s.height_m,
                     .height_msl_m = s.height_msl_m,
                     .speed_m_s = s.speed_m_s,
                     .course_rad = s.course_rad,
                     .climb_m_s = s.climb_m_s,
                     .dop = s.dop,
                     .visible = s.visible,
                     .tracked = s.tracked,
                     .position_std_m = s.position_std_m,
                     .height_std_m = s.height_std_m,
                     .velocity_std_m_s = s.velocity_std_m_s};
  }
  Result operator()(const instruments::SkySample& /*s*/) const { return std::nullopt; }
  Result operator()(const instruments::MotorSample& s) const {
    return MotorSample{.rpm_commanded = s.rpm_commanded,
                       .rpm = s.rpm,
                       .fins_rad = s.fins_rad,
                       .current_A = s.current_A,
                       .sequence = s.sequence,
                       .fins_std_rad = s.fins_std_rad,
                       .current_std_A = s.current_std_A};
  }
  Result operator()(const instruments::AltimeterSample& s) const {
    return AltimeterSample{.altitude_m = s.altitude_m, .altitude_std_m = s.altitude_std_m};
  }
  Result operator()(const instruments::PowerSample& s) const {
    return PowerSample{.voltage_V = s.voltage_V, .current_A = s.current_A};
  }
  Result operator()(const instruments::DvlSample& s) const {
    const bool is_body = s.frame == instruments::VelocityFrame::body;
    return DvlSample{.frame = is_body ? VelocityFrame::body : VelocityFrame::earth,
                     .bottom_velocity_m_s = s.bottom_velocity_m_s,
                     .bottom_velocity_std_m_s = s.bottom_velocity_std_m_s,
                     .water_velocity_m_s = s.water_velocity_m_s,
                     .water_velocity_std_m_s = s.water_velocity_std_m_s,
                     .altitude_m = s.altitude_m,
                     .altitude_std_m = s.altitude_std_m,
                     .temperature_C = s.temperature_C,
                     .sound_speed_m_s = s.sound_speed_m_s};
  }
  Result operator()(const instruments::DepthSample& s) const {
    return DepthSample{.depth_m = s.depth_m,
                       .depth_std_m = s.depth_std_m,
                       .pressure_Pa = s.pressure_Pa,
                       .pressure_std_Pa = s.pressure_std_Pa,
                       .temperature_C = s.temperature_C};
  }
  Result operator()(const instruments::ScalarSample& s) const {
    return ScalarSample{.quantity = std::string(s.quantity.view()),
                        .unit = std::string(s.unit.view()),
                        .value = s.value,
                        .value_std = s.value_std};
  }
};

}  // namespace

std::optional<Sample> sample_of(const instruments::Sample& sample) {
  auto value = std::visit(MeasurementOf{}, sample.value);
  if (!value) return std::nullopt;
  return Sample{sample.port, stamp_of(sample.stamp), name_of_calibration(sample.calibration), std::move(*value)};
}

Sample sample_of(const pipeline::NavigationSample& sample) {
  const auto& estimate = sample.estimate;
  NavigationSample value{.latitude_rad = sample.latitude_rad,
                         .longitude_rad = sample.longitude_rad,
                         .north_std_m = {},
                         .east_std_m = {},
                         .since_fix_s = {},
                         .since_fix_m = {},
                         .depth_m = estimate.depth_m,
                         .heading_rad = estimate.heading_rad,
                         .heading_std_rad = {},
                         .pitch_rad = estimate.pitch_rad,
                         .roll_rad = estimate.roll_rad,
                         .speed_m_s = estimate.speed_m_s,
                         .velocity_m_s = {},
                         .set_north_m_s = {},
                         .set_east_m_s = {},
                         .altitude_m = sample.altitude_m,
                         .altitude_std_m = sample.altitude_std_m,
                         .water_depth_m = sample.water_depth_m};
  if (estimate.position_m) {
    value.north_std_m = estimate.position_std_m.x();
    value.east_std_m = estimate.position_std_m.y();
    value.since_fix_s = estimate.since_fix_s;
    value.since_fix_m = estimate.since_fix_m;
    value.set_north_m_s = estimate.set_m_s.x();
    value.set_east_m_s = estimate.set_m_s.y();
  }
  if (estimate.heading_rad) value.heading_std_rad = estimate.heading_std_rad;
  if (const auto& v = estimate.velocity_m_s) value.velocity_m_s = Vector3{v->x(), v->y(), v->z()};
  return {Sample::kNoPort, stamp_of(sample.stamp), name_of_calibration(sample.calibration), std::move(value)};
}

Sample sample_of(const pipeline::BatterySample& sample) {
  BatterySample value{.voltage_V = sample.voltage_V,
                      .current_A = sample.current_A,
                      .current_measured = sample.current_is_measured,
                      .charge_Ah = {},
                      .charge_std_Ah = {},
                      .time_left_s = sample.time_left_s,
                      .range_left_m = sample.range_left_m,
                      .low = sample.low};
  if (sample.charge) {
    value.charge_Ah = sample.charge->charge_Ah;
    value.charge_std_Ah = sample.charge->std_Ah;
  }
  return {sample.port, stamp_of(sample.stamp), {}, value};
}

std::vector<Port> ports_of(const config::Settings& settings) {
  std::vector<Port> ports;
  for (const auto& port : settings.ports) {
    ports.push_back({port.name, std::string(protocols::name_of(port.protocol)), port.baud});
  }
  return ports;
}

}  // namespace navcal::api
