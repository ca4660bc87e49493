// SPDX-License-Identifier: Apache-2.0
#include "api/sample_of.h"

#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>

#include "instruments/sample_fields.h"
#include "protocols/frame.h"

namespace navcal::api {
namespace {

Stamp stamp_of(const instruments::Stamp& stamp) {
  return {stamp.arrival_ns, stamp.validity_ns, stamp.std_ns, stamp.arrival_utc_ns, stamp.validity_utc_ns};
}

CalibrationName name_of_calibration(const instruments::CalibrationName& name) { return {name.number, name.sum}; }

static_assert(static_cast<int>(Fix::bad_geometry) == static_cast<int>(instruments::Fix::bad_geometry));
static_assert(static_cast<int>(VelocityFrame::earth) == static_cast<int>(instruments::VelocityFrame::earth));

/// A member as the library has it: the same type, the counterpart of a name, or a text.
template <class To, class From>
To member_of(const From& from) {
  if constexpr (std::is_enum_v<From>) {
    return static_cast<To>(from);
  } else if constexpr (std::is_same_v<To, std::string>) {
    return std::string(from.view());
  } else {
    return from;
  }
}

template <class To, class From>
To with_same_members(const From& from) {
  To to;
  if constexpr (requires { from.card; }) {
    if (from.card) to.card.emplace();
  }
  constexpr auto kFrom = instruments::kKind<From>.fields;
  constexpr auto kTo = instruments::kKind<To>.fields;
  [&]<std::size_t... I>(std::index_sequence<I...>) {
    const auto copy = [&](const auto& source, const auto& target) {
      const auto* const value = instruments::member_of(from, source);
      auto* const place = instruments::member_of(to, target);
      if (value != nullptr) *place = member_of<std::decay_t<decltype(*place)>>(*value);
    };
    (copy(std::get<I>(kFrom), std::get<I>(kTo)), ...);
  }
  (std::make_index_sequence<std::tuple_size_v<decltype(kFrom)>>{});
  if constexpr (requires { from.time_utc_ns; }) to.time_utc_ns = from.time_utc_ns;
  return to;
}

/// The public counterpart of each kind of sample.
struct MeasurementOf {
  using Result = std::optional<Measurement>;

  Result operator()(const instruments::CompassSample& s) const { return with_same_members<CompassSample>(s); }
  Result operator()(const instruments::ImuSample& s) const { return with_same_members<ImuSample>(s); }
  Result operator()(const instruments::GpsSample& s) const { return with_same_members<GpsSample>(s); }
  Result operator()(const instruments::SkySample& /*s*/) const { return std::nullopt; }
  Result operator()(const instruments::MotorSample& s) const { return with_same_members<MotorSample>(s); }
  Result operator()(const instruments::AltimeterSample& s) const { return with_same_members<AltimeterSample>(s); }
  Result operator()(const instruments::PowerSample& s) const { return with_same_members<PowerSample>(s); }
  Result operator()(const instruments::DvlSample& s) const { return with_same_members<DvlSample>(s); }
  Result operator()(const instruments::DepthSample& s) const { return with_same_members<DepthSample>(s); }
  Result operator()(const instruments::ScalarSample& s) const { return with_same_members<ScalarSample>(s); }
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
