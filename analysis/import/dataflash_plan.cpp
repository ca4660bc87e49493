// SPDX-License-Identifier: Apache-2.0
#include "analysis/import/dataflash_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "base/angles.h"

namespace navcal::analysis::dataflash {
namespace {

/// What a field measures: the labels of UNIT that fit, each with its factor to navcal's unit.
struct Dimension {
  std::string_view words;
  struct Label {
    std::string_view text;
    double factor;
  };
  std::array<Label, 4> labels{};
  double unstated = 1;  ///< factor where the log states no unit
};

constexpr double kRad = base::kRadiansPerDegree;
constexpr Dimension kAny{"anything"};
constexpr Dimension kRate{"a rate", {{{"rad/s", 1}, {"deg/s", kRad}}}};
constexpr Dimension kForce{"an acceleration", {{{"m/s/s", 1}}}};
constexpr Dimension kField{"a magnetic field", {{{"Gauss", 100}, {"mGauss", 0.1}}}, 0.1};  // to microtesla
constexpr Dimension kPressure{"a pressure", {{{"Pa", 1}, {"hPa", 100}}}};
constexpr Dimension kTemperature{"a temperature", {{{"degC", 1}}}};
constexpr Dimension kLength{"a length", {{{"m", 1}}}};
constexpr Dimension kSpeed{"a speed", {{{"m/s", 1}}}};
constexpr Dimension kPlace{"degrees of a place", {{{"deglatitude", 1}, {"deglongitude", 1}, {"deg", 1}}}};
constexpr Dimension kAngle{"an angle", {{{"deg", kRad}, {"degheading", kRad}, {"rad", 1}}}, kRad};
constexpr Dimension kVoltage{"a voltage", {{{"V", 1}}}};
constexpr Dimension kCurrent{"a current", {{{"A", 1}}}};

struct Field {
  std::string_view column;
  const Dimension* dimension;
  bool required = true;
};

constexpr std::array kImuFields{Field{"GyrX", &kRate},           Field{"GyrY", &kRate},  Field{"GyrZ", &kRate},
                                Field{"AccX", &kForce},          Field{"AccY", &kForce}, Field{"AccZ", &kForce},
                                Field{"T", &kTemperature, false}};
constexpr std::array kMagFields{Field{"MagX", &kField},        Field{"MagY", &kField},
                                Field{"MagZ", &kField},        Field{"Health", &kAny, false},
                                Field{"MOX", &kField, false},  Field{"MOY", &kField, false},
                                Field{"MOZ", &kField, false},  Field{"OfsX", &kField, false},
                                Field{"OfsY", &kField, false}, Field{"OfsZ", &kField, false}};
constexpr std::array kBaroFields{Field{"Press", &kPressure}, Field{"Temp", &kTemperature, false},
                                 Field{"Alt", &kLength, false}};
constexpr std::array kGpsFields{
    Field{"Status", &kAny},        Field{"GMS", &kAny, false},    Field{"GWk", &kAny, false},
    Field{"NSats", &kAny, false},  Field{"HDop", &kAny, false},   Field{"Lat", &kPlace},
    Field{"Lng", &kPlace},         Field{"Alt", &kLength, false}, Field{"Spd", &kSpeed, false},
    Field{"GCrs", &kAngle, false}, Field{"VZ", &kSpeed, false}};
constexpr std::array kAccuracyFields{Field{"HAcc", &kLength, false}, Field{"VAcc", &kLength, false},
                                     Field{"SAcc", &kSpeed, false}};
constexpr std::array kAttitudeFields{Field{"Roll", &kAngle}, Field{"Pitch", &kAngle}, Field{"Yaw", &kAngle},
                                     Field{"AEKF", &kAny, false}};
constexpr std::array kVarianceFields{Field{"V00", &kAny}, Field{"V03", &kAny}};
constexpr std::array kBatteryFields{Field{"Volt", &kVoltage}, Field{"Curr", &kCurrent, false}};
constexpr std::array kParameterFields{Field{"Name", &kAny}, Field{"Value", &kAny}};
constexpr std::array kTextFields{Field{"Message", &kAny}};

std::span<const Field> fields_of(Kind kind) {
  switch (kind) {
    case Kind::imu: return kImuFields;
    case Kind::mag: return kMagFields;
    case Kind::baro: return kBaroFields;
    case Kind::gps: return kGpsFields;
    case Kind::gps_accuracy: return kAccuracyFields;
    case Kind::attitude: return kAttitudeFields;
    case Kind::state_variances: return kVarianceFields;
    case Kind::battery: return kBatteryFields;
    case Kind::parameter: return kParameterFields;
    case Kind::text: return kTextFields;
    case Kind::outputs:
    case Kind::other: break;
  }
  return {};
}

std::optional<double> factor_of(const Dimension& dimension, std::string_view unit) {
  if (unit.empty() || &dimension == &kAny) return dimension.unstated;
  const auto found = std::ranges::find(dimension.labels, unit, &Dimension::Label::text);
  return found == dimension.labels.end() ? std::nullopt : std::optional(found->factor);
}

}  // namespace

KindOfName kind_of(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, Kind>, 12> kNames{{{"IMU", Kind::imu},
                                                                      {"MAG", Kind::mag},
                                                                      {"BARO", Kind::baro},
                                                                      {"BAR", Kind::baro},
                                                                      {"GPS", Kind::gps},
                                                                      {"GPA", Kind::gps_accuracy},
                                                                      {"ATT", Kind::attitude},
                                                                      {"XKV1", Kind::state_variances},
                                                                      {"BAT", Kind::battery},
                                                                      {"RCOU", Kind::outputs},
                                                                      {"PARM", Kind::parameter},
                                                                      {"MSG", Kind::text}}};
  KindOfName found;
  if (!name.empty() && name.back() >= '2' && name.back() <= '9') {
    found.instance = name.back() - '1';
    name.remove_suffix(1);
  }
  for (const auto& [text, kind] : kNames) {
    if (text == name) found.kind = kind;
  }
  return found;
}

Plan::Plan(const Table& table, const MessageType& type) : version_(table.version()) {
  const KindOfName found = kind_of(type.name);
  kind_ = found.kind;
  instance_of_name_ = found.instance;
  time_ = type.find("TimeUS");
  if (time_ == nullptr) {
    time_ = type.find("TimeMS");
    time_unit_ns_ = 1'000'000;
  }
  // Before TimeUS, a GPS message had the time of the week as TimeMS beside Week, and the time since boot as T.
  const Column* const old_week = kind_ == Kind::gps && time_unit_ns_ != 1000 ? type.find("Week") : nullptr;
  const Column* const old_ms = time_;
  if (old_week != nullptr) time_ = type.find("T");
  instance_ = type.instance();
  if (time_ == nullptr) why_not_ = "no time";
  if (kind_ == Kind::outputs) {
    for (const Column& column : type.columns) {
      if (column.name.size() > 1 && column.name[0] == 'C' && column.name[1] >= '1' && column.name[1] <= '9')
        channels_.push_back(&column);
    }
  }
  const auto fields = fields_of(kind_);
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const Column* const column = type.find(fields[i].column);
    if (column == nullptr) {
      if (fields[i].required) why_not_ = fmt::format("no column {}", fields[i].column);
      continue;
    }
    const auto factor = factor_of(*fields[i].dimension, table.unit(*column));
    if (factor) {
      fields_[i] = {column, *factor};
    } else if (fields[i].required) {
      why_not_ = fmt::format("unit \"{}\" of {} is none of {}", table.unit(*column), column->name,
                             fields[i].dimension->words);
    }
  }
  constexpr std::size_t kWeekMs = 1, kWeek = 2;  // of kGpsFields
  if (old_week != nullptr) fields_[kWeekMs].column = old_ms, fields_[kWeek].column = old_week;
}

std::optional<std::int64_t> Plan::time_ns(std::string_view record) const {
  const auto time = integer_of(*time_, record);
  constexpr std::int64_t kMostTime = INT64_MAX / 4;
  if (!time || *time < 0 || *time > kMostTime / time_unit_ns_) return std::nullopt;
  return *time * time_unit_ns_;
}

int Plan::instance(std::string_view record) const {
  if (instance_ == nullptr) return instance_of_name_;
  return static_cast<int>(integer_of(*instance_, record).value_or(0));
}

std::optional<double> Plan::field(const Table& table, std::string_view record, std::size_t i) const {
  const Bound& bound = fields_[i];
  if (bound.column == nullptr) return std::nullopt;
  const auto value = table.value(*bound.column, record);
  return value ? std::optional(*value * bound.factor) : std::nullopt;
}

std::optional<std::int64_t> Plan::integer(std::string_view record, std::size_t i) const {
  return fields_[i].column == nullptr ? std::nullopt : integer_of(*fields_[i].column, record);
}

std::string_view Plan::text(std::string_view record, std::size_t i) const {
  return fields_[i].column == nullptr ? std::string_view{} : text_of(*fields_[i].column, record);
}

}  // namespace navcal::analysis::dataflash
