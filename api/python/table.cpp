// SPDX-License-Identifier: Apache-2.0
#include "api/python/table.h"

#include <limits>
#include <memory>
#include <string>
#include <type_traits>

#include "instruments/sample_fields.h"

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

/// A member into its column; angles of a place in radians.
struct MemberColumn {
  Table& table;
  const char* name;

  void operator()(double value) const { table.put(name, std::optional(value)); }
  void operator()(const std::optional<double>& value) const { table.put(name, value); }
  void operator()(const std::optional<api::Vector3>& values) const { table.put(name, values); }
  void operator()(const std::array<std::optional<double>, 3>& values) const { table.put(name, values); }
  void operator()(const std::optional<std::uint8_t>& count) const {
    table.put(name, std::optional<double>(count));
  }
  void operator()(const std::optional<std::uint32_t>& code) const {
    table.put(name, static_cast<std::int64_t>(code.value_or(0)));
  }
  void operator()(bool flag) const { table.put_flag(name, flag); }
  void operator()(const std::string& words) const { table.put_text(name, words); }
  void operator()(api::Fix fix) const { table.put_text(name, std::string(name_of(fix))); }
  void operator()(api::VelocityFrame frame) const { table.put_text(name, std::string(name_of(frame))); }
};

/// Members of a sample into the columns of its kind, with the keys of `navcal replay`.
struct Rows {
  Table& table;

  template <class S>
  void operator()(const S& sample) const {
    instruments::for_each_field<S>([&]<class Owner, class T>(const instruments::kind::Field<Owner, T>& field) {
      const char* name = field.key.data();
      if (field.key == "lat") name = "latitude_rad";
      if (field.key == "lon") name = "longitude_rad";
      const auto* const member = instruments::member_of(sample, field);
      if constexpr (std::is_same_v<T, std::uint8_t>) {
        table.put(name, member != nullptr ? std::optional<double>(*member) : std::nullopt);
      } else {
        MemberColumn{table, name}(member != nullptr ? *member : T{});
      }
    });
  }
  void operator()(const api::NavigationSample& s) const {
    table.put("latitude_rad", s.latitude_rad);
    table.put("longitude_rad", s.longitude_rad);
    table.put("north_std_m", s.north_std_m);
    table.put("east_std_m", s.east_std_m);
    table.put("since_fix_s", s.since_fix_s);
    table.put("since_fix_m", s.since_fix_m);
    table.put("depth_m", s.depth_m);
    table.put("depth_std_m", s.depth_std_m);
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
  template <class S>
  const char* operator()(const S&) const {
    return instruments::kKind<S>.name.data();
  }
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
            return array_of(std::forward<decltype(values)>(values), column.width);
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
