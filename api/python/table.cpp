// SPDX-License-Identifier: Apache-2.0
#include "api/python/table.h"

#include <limits>
#include <memory>
#include <type_traits>

namespace navcal::python {
namespace {

namespace py = pybind11;

/// An array that owns the vector whose memory it shows.
template <class Element>
py::array array_of(std::vector<Element>&& values, std::size_t width) {
  auto kept = std::make_unique<std::vector<Element>>(std::move(values));
  const auto rows = static_cast<py::ssize_t>(kept->size() / width);
  std::vector<py::ssize_t> shape{rows};
  if (width > 1) shape.push_back(static_cast<py::ssize_t>(width));
  Element* const data = kept->data();
  const py::capsule owner(kept.get(), [](void* vector) { delete static_cast<std::vector<Element>*>(vector); });
  (void)kept.release();
  using Shown = std::conditional_t<std::is_same_v<Element, std::uint8_t>, bool, Element>;
  return py::array(py::dtype::of<Shown>(), shape, data, owner);
}

/// Members of a sample into the columns of its kind, with the keys of `navcal replay`; angles of a place in
/// radians.
struct Rows {
  Table& table;

  void operator()(const api::CompassSample& s) const {
    table.put("heading_rad", s.heading_rad);
    table.put_flag("heading_is_true", s.heading_is_true);
    table.put("heading_calibrated_rad", s.heading_calibrated_rad);
    table.put("pitch_rad", s.pitch_rad);
    table.put("roll_rad", s.roll_rad);
    table.put_flag("tilt_by_accelerometers", s.tilt_by_accelerometers);
    table.put("field_body_uT", s.field_body_uT);
    table.put("dip_rad", s.dip_rad);
    table.put("turn_rate_rad_s", s.turn_rate_rad_s);
    table.put("temperature_C", s.temperature_C);
    table.put("error", static_cast<std::int64_t>(s.error.value_or(0)));
    table.put("heading_std_rad", s.heading_std_rad);
    table.put("tilt_std_rad", s.tilt_std_rad);
    table.put("field_std_uT", s.field_std_uT);
  }
  void operator()(const api::ImuSample& s) const {
    table.put("rate_rad_s", s.rate_rad_s);
    table.put("yaw_rate_b_rad_s", s.yaw_rate_b_rad_s);
    table.put("yaw_rate_calibrated_rad_s", s.yaw_rate_calibrated_rad_s);
    table.put("yaw_rate_b_calibrated_rad_s", s.yaw_rate_b_calibrated_rad_s);
    table.put("specific_force_m_s2", s.specific_force_m_s2);
    table.put("depth_m", s.depth_m);
    table.put("temperature_C", s.temperature_C);
    table.put_flag("over_range", s.over_range);
    table.put_flag("leak_forward", s.card && s.card->leak_forward);
    table.put_flag("leak_aft", s.card && s.card->leak_aft);
    table.put_flag("low_supply", s.card && s.card->low_supply);
    table.put("rate_std_rad_s", s.rate_std_rad_s);
    table.put("specific_force_std_m_s2", s.specific_force_std_m_s2);
    table.put("depth_std_m", s.depth_std_m);
  }
  void operator()(const api::GpsSample& s) const {
    constexpr std::array kFixes{"none", "2d", "3d", "propagated", "hold", "acquiring", "bad_geometry"};
    table.put_text("fix", kFixes.at(static_cast<std::size_t>(s.fix)));
    table.put("latitude_rad", s.latitude_rad);
    table.put("longitude_rad", s.longitude_rad);
    table.put("height_m", s.height_m);
    table.put("height_msl_m", s.height_msl_m);
    table.put("speed_m_s", s.speed_m_s);
    table.put("course_rad", s.course_rad);
    table.put("climb_m_s", s.climb_m_s);
    table.put("dop", s.dop);
    table.put("position_std_m", s.position_std_m);
    table.put("height_std_m", s.height_std_m);
    table.put("velocity_std_m_s", s.velocity_std_m_s);
  }
  void operator()(const api::MotorSample& s) const {
    table.put("rpm_commanded", s.rpm_commanded);
    table.put("rpm", s.rpm);
    table.put("fins_rad", s.fins_rad);
    table.put("current_A", s.current_A);
    table.put("fins_std_rad", s.fins_std_rad);
    table.put("current_std_A", s.current_std_A);
  }
  void operator()(const api::AltimeterSample& s) const {
    table.put("altitude_m", std::optional(s.altitude_m));
    table.put("altitude_std_m", s.altitude_std_m);
  }
  void operator()(const api::PowerSample& s) const {
    table.put("voltage_V", s.voltage_V);
    table.put("current_A", s.current_A);
  }
  void operator()(const api::DvlSample& s) const {
    table.put_text("frame", s.frame == api::VelocityFrame::body ? "body" : "earth");
    table.put("bottom_velocity_m_s", s.bottom_velocity_m_s);
    table.put("bottom_velocity_std_m_s", s.bottom_velocity_std_m_s);
    table.put("water_velocity_m_s", s.water_velocity_m_s);
    table.put("water_velocity_std_m_s", s.water_velocity_std_m_s);
    table.put("altitude_m", s.altitude_m);
    table.put("altitude_std_m", s.altitude_std_m);
    table.put("temperature_C", s.temperature_C);
    table.put("sound_speed_m_s", s.sound_speed_m_s);
  }
  void operator()(const api::DepthSample& s) const {
    table.put("depth_m", s.depth_m);
    table.put("depth_std_m", s.depth_std_m);
    table.put("pressure_Pa", s.pressure_Pa);
    table.put("pressure_std_Pa", s.pressure_std_Pa);
    table.put("temperature_C", s.temperature_C);
  }
  void operator()(const api::ScalarSample& s) const {
    table.put_text("quantity", s.quantity);
    table.put_text("unit", s.unit);
    table.put("value", std::optional(s.value));
    table.put("value_std", s.value_std);
  }
  void operator()(const api::NavigationSample& s) const {
    table.put("latitude_rad", s.latitude_rad);
    table.put("longitude_rad", s.longitude_rad);
    table.put("north_std_m", s.north_std_m);
    table.put("east_std_m", s.east_std_m);
    table.put("since_fix_s", s.since_fix_s);
    table.put("since_fix_m", s.since_fix_m);
    table.put("depth_m", s.depth_m);
    table.put("heading_rad", s.heading_rad);
    table.put("heading_std_rad", s.heading_std_rad);
    table.put("pitch_rad", s.pitch_rad);
    table.put("roll_rad", s.roll_rad);
    table.put("speed_m_s", s.speed_m_s);
    table.put("velocity_m_s", s.velocity_m_s);
    table.put("set_north_m_s", s.set_north_m_s);
    table.put("set_east_m_s", s.set_east_m_s);
    table.put("altitude_m", s.altitude_m);
    table.put("altitude_std_m", s.altitude_std_m);
    table.put("water_depth_m", s.water_depth_m);
  }
  void operator()(const api::BatterySample& s) const {
    table.put("voltage_V", s.voltage_V);
    table.put("current_A", s.current_A);
    table.put_flag("current_measured", s.current_measured);
    table.put("charge_Ah", s.charge_Ah);
    table.put("charge_std_Ah", s.charge_std_Ah);
    table.put("time_left_s", s.time_left_s);
    table.put("range_left_m", s.range_left_m);
    table.put_flag("low", s.low);
  }
};

struct KindNames {
  const char* operator()(const api::CompassSample&) const { return "compass"; }
  const char* operator()(const api::ImuSample&) const { return "imu"; }
  const char* operator()(const api::GpsSample&) const { return "gps"; }
  const char* operator()(const api::MotorSample&) const { return "motor"; }
  const char* operator()(const api::AltimeterSample&) const { return "altimeter"; }
  const char* operator()(const api::PowerSample&) const { return "power"; }
  const char* operator()(const api::DvlSample&) const { return "dvl"; }
  const char* operator()(const api::DepthSample&) const { return "depth"; }
  const char* operator()(const api::ScalarSample&) const { return "sensor"; }
  const char* operator()(const api::NavigationSample&) const { return "navigation"; }
  const char* operator()(const api::BatterySample&) const { return "battery"; }
};

constexpr double kAbsent = std::numeric_limits<double>::quiet_NaN();

}  // namespace

template <class Values>
Values& Table::column(const char* name, std::size_t width) {
  if (next_ == columns_.size()) columns_.push_back({name, width, Values{}});
  return std::get<Values>(columns_[next_++].values);
}

void Table::put(const char* name, const std::optional<double>& value) {
  column<Numbers>(name).push_back(value.value_or(kAbsent));
}

void Table::put(const char* name, const std::optional<api::Vector3>& value) {
  auto& values = column<Numbers>(name, 3);
  for (std::size_t i = 0; i < 3; ++i) values.push_back(value ? (*value)[i] : kAbsent);
}

void Table::put(const char* name, const std::array<std::optional<double>, 3>& value) {
  auto& values = column<Numbers>(name, 3);
  for (const auto& component : value) values.push_back(component.value_or(kAbsent));
}

void Table::put(const char* name, std::int64_t value) { column<Integers>(name).push_back(value); }

void Table::put_flag(const char* name, bool value) {
  column<Flags>(name).push_back(static_cast<std::uint8_t>(value));
}

void Table::put_text(const char* name, std::string value) { column<Texts>(name).push_back(std::move(value)); }

py::dict Table::release() {
  py::dict arrays;
  for (Column& column : columns_) {
    arrays[py::str(column.name)] = std::visit(
        [&](auto&& values) -> py::object {
          using Values = std::decay_t<decltype(values)>;
          if constexpr (std::is_same_v<Values, Texts>) {
            return py::cast(values);
          } else {
            return array_of(std::move(values), column.width);
          }
        },
        std::move(column.values));
  }
  columns_.clear();
  return arrays;
}

const char* name_of(const api::Measurement& value) { return std::visit(KindNames{}, value); }

void append(Table& table, const api::Sample& sample) {
  table.begin_row();
  table.put("time_ns", sample.stamp.validity_utc_ns);
  table.put("time_std_ns", sample.stamp.std_ns);
  table.put("arrival_ns", sample.stamp.arrival_utc_ns);
  table.put("validity_monotonic_ns", sample.stamp.validity_ns);
  table.put("arrival_monotonic_ns", sample.stamp.arrival_ns);
  table.put("port",
            sample.port == api::Sample::kNoPort ? std::int64_t{-1} : static_cast<std::int64_t>(sample.port));
  table.put("calibration", static_cast<std::int64_t>(sample.calibration.number));
  std::visit(Rows{table}, sample.value);
}

}  // namespace navcal::python
