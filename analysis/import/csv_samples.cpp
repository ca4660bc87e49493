// SPDX-License-Identifier: Apache-2.0
#include "analysis/import/csv_samples.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <type_traits>
#include <utility>

#include "base/angles.h"

namespace navcal::analysis {
namespace {

using instruments::Form;
using protocols::described::Meaning;
using protocols::samples_line::LineWriter;
using Shape = CsvSamples::Shape;

/// The member of a sample that a meaning fills. A list has three meanings in a row, and this is that of the first.
struct Target {
  std::string_view key;
  Shape shape = Shape::number;
  Form form = Form::plain;
};

template <class T>
constexpr Shape kShapeOf = Shape::number;
template <>
constexpr Shape kShapeOf<std::optional<instruments::Vector3>> = Shape::vector;
template <>
constexpr Shape kShapeOf<std::array<std::optional<double>, 3>> = Shape::three;

/// nullopt for another than the first of a list, and for a sensor.
std::optional<Target> target_of(const config::ColumnMeaning& meaning) {
  std::optional<Target> target;
  instruments::for_each_kind([&]<class S>(std::type_identity<S>) {
    if (instruments::kKind<S>.class_name != meaning.sample) return;
    instruments::for_each_field<S>([&]<class Owner, class T>(const instruments::kind::Field<Owner, T>& field) {
      if (field.meaning == meaning.quantity && field.quantity.role == instruments::Role::measured)
        target = Target{field.key, kShapeOf<T>, field.quantity.form};
    });
  });
  return target;
}

PortKind port_of(std::string_view class_name) {
  constexpr std::array<std::pair<std::string_view, PortKind>, 8> kPorts{{{"COMPASS", PortKind::compass},
                                                                         {"IMU", PortKind::imu},
                                                                         {"GPS", PortKind::gps},
                                                                         {"DEPTH", PortKind::depth},
                                                                         {"ALTIMETER", PortKind::altimeter},
                                                                         {"DVL", PortKind::dvl},
                                                                         {"MOTOR", PortKind::motor},
                                                                         {"POWER", PortKind::battery}}};
  return std::ranges::find_if(kPorts, [&](const auto& row) { return row.first == class_name; })->second;
}

}  // namespace

CsvSamples::Group& CsvSamples::group_of(std::string_view class_name, std::string_view port) {
  const auto found = std::ranges::find_if(
      groups_, [&](const Group& group) { return group.port == port && group.class_name == class_name; });
  if (found != groups_.end()) return *found;
  groups_.push_back(
      {std::string(class_name), std::string(port), fmt::format("{} {}", class_name, port), {}, {}, {}});
  return groups_.back();
}

CsvSamples::CsvSamples(const config::CsvMap& map) {
  const auto place_of = [&](std::string_view sample, Meaning quantity,
                            int instance) -> std::optional<std::size_t> {
    for (std::size_t i = 0; i < map.columns.size(); ++i) {
      const auto& [name, its_quantity, its_sample] = map.columns[i].meaning;
      if (its_sample == sample && its_quantity == quantity && map.columns[i].instance == instance) return i;
    }
    return std::nullopt;
  };
  constexpr int kInstances = 9;
  for (const config::ColumnMeaning& meaning : config::column_meanings()) {
    const auto target = target_of(meaning);
    if (!target) continue;
    for (int instance = 0; instance < kInstances; ++instance) {
      Member member{target->shape, target->form, {}, std::string(target->key)};
      const std::size_t count = target->shape == Shape::number ? 1 : member.columns.size();
      std::size_t found = 0;
      for (std::size_t i = 0; i < count; ++i) {
        member.columns[i] = place_of(
            meaning.sample, static_cast<Meaning>(static_cast<std::size_t>(meaning.quantity) + i), instance);
        if (member.columns[i]) ++found;
      }
      if (found == 0 || (target->shape == Shape::vector && found < count)) continue;
      group_of(meaning.sample, port_name(port_of(meaning.sample), instance)).members.push_back(std::move(member));
    }
  }
  for (std::size_t i = 0; i < map.columns.size(); ++i) {
    const auto& column = map.columns[i];
    if (column.meaning.quantity != Meaning::sensor) continue;
    groups_.push_back({"SENSOR",
                       std::string(port_name(PortKind::sensors, column.instance)),
                       fmt::format("SENSOR {}", column.quantity),
                       {{Shape::number, Form::plain, {i}, "value"}},
                       column.quantity,
                       column.unit});
  }
}

bool CsvSamples::write(const Member& member, const std::vector<std::optional<double>>& values, LineWriter& line) {
  std::array<std::optional<double>, 3> three;
  for (std::size_t i = 0; i < three.size(); ++i) {
    if (member.columns[i]) three[i] = values[*member.columns[i]];
  }
  switch (member.shape) {
    case Shape::number:
      if (!three[0]) return false;
      line.number(member.key, member.form == Form::direction ? base::as_heading(*three[0]) : *three[0]);
      return true;
    case Shape::vector:
      if (!three[0] || !three[1] || !three[2]) return false;
      line.vector(member.key, {*three[0], *three[1], *three[2]});
      return true;
    case Shape::three:
      if (!three[0] && !three[1] && !three[2]) return false;
      line.three(member.key, three);
      return true;
  }
  return false;
}

void CsvSamples::emit(std::int64_t time_ns, const std::vector<std::optional<double>>& values,
                      ImportSink& sink) const {
  for (const Group& group : groups_) {
    LineWriter line(group.class_name);
    if (group.class_name == "SENSOR") line.text("quantity", group.quantity).text("unit", group.unit);
    if (group.class_name == "DVL") line.text("frame", "body");
    bool has_any = false;
    for (const Member& member : group.members) {
      if (write(member, values, line)) has_any = true;
    }
    // A position is a fix, although the file says nothing of its quality.
    if (has_any && group.class_name == "GPS") line.text("fix", "3d");
    if (has_any) sink.sample({group.message, group.port, time_ns}, line);
  }
}

}  // namespace navcal::analysis
