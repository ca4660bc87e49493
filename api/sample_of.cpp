// SPDX-License-Identifier: Apache-2.0
#include "api/sample_of.h"

#include <string>
#include <utility>
#include <variant>

#include "protocols/frame.h"

namespace navcal::api {
namespace {

/// The public counterpart of each kind of sample.
struct MeasurementOf {
  using Result = std::optional<Measurement>;

  Result operator()(const instruments::SkySample& /*s*/) const { return std::nullopt; }
  Result operator()(const instruments::ScalarSample& s) const {
    return ScalarSample{std::string(s.quantity.view()), std::string(s.unit.view()), s.value, s.value_std};
  }
  Result operator()(const auto& sample) const { return sample; }
};

}  // namespace

std::optional<Sample> sample_of(const instruments::Sample& sample) {
  auto value = std::visit(MeasurementOf{}, sample.value);
  if (!value) return std::nullopt;
  return Sample{sample.port, sample.stamp, sample.calibration, std::move(*value)};
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
                         .depth_std_m = estimate.depth_std_m,
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
  return {Sample::kNoPort, sample.stamp, sample.calibration, value};
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
  return {sample.port, sample.stamp, {}, value};
}

std::vector<Port> ports_of(const config::Settings& settings) {
  std::vector<Port> ports;
  for (const auto& port : settings.ports) {
    ports.push_back({port.name, std::string(protocols::name_of(port.protocol)), port.baud});
  }
  return ports;
}

}  // namespace navcal::api
