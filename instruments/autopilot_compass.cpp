// SPDX-License-Identifier: Apache-2.0
#include "instruments/autopilot_compass.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace navcal::instruments {
namespace {

constexpr std::string_view kPrefix = "COMPASS_", kMotorSource = "COMPASS_MOTCT", kAxes = "XYZ";
constexpr double kMilliGauss_uT = 0.1;

bool are_known(const std::array<std::optional<double>, 3>& values) {
  return std::ranges::all_of(values, [](const auto& value) { return value.has_value(); });
}

}  // namespace

// COMPASS_OFS_X, COMPASS_OFS2_X, COMPASS_SCALE, COMPASS_SCALE2.
void AutopilotCompass::take(std::string_view name, double value) {
  if (!name.starts_with(kPrefix) || !std::isfinite(value)) return;
  if (name == kMotorSource) {
    motor_source_ = static_cast<int>(std::clamp(value, 0.0, 3.0));
    return;
  }
  name.remove_prefix(kPrefix.size());
  const auto number = name.find_first_of("123");
  const std::size_t unit = number == std::string_view::npos ? 0 : static_cast<std::size_t>(name[number] - '1');
  const std::string_view kind = name.substr(0, std::min(number, name.find('_')));
  Unit& of = units_.at(unit);
  if (kind == "SCALE") of.scale = value == 0 ? 1 : value;
  const auto axis =
      name.size() < 2 || name[name.size() - 2] != '_' ? std::string_view::npos : kAxes.find(name.back());
  if (axis == std::string_view::npos) return;
  if (kind == "OFS") of.offset_mG.at(axis) = value;
  if (kind == "DIA") of.diagonal.at(axis) = value;
  if (kind == "ODI") of.off_diagonal.at(axis) = value;
  if (kind == "MOT") of.motor_mG_per_A.at(axis) = value;
}

void AutopilotCompass::take_offset(int unit, const Vector3& offset_uT) {
  constexpr double kCut_mG = 1;
  auto& offset_mG = units_.at(static_cast<std::size_t>(unit)).offset_mG;
  for (std::size_t axis = 0; axis < offset_uT.size(); ++axis) {
    const double stated_mG = offset_uT[axis] / kMilliGauss_uT;
    const bool is_new = !offset_mG[axis] || std::abs(stated_mG - *offset_mG[axis]) >= kCut_mG;
    if (std::isfinite(stated_mG) && is_new) offset_mG[axis] = stated_mG;
  }
}

std::optional<Vector3> AutopilotCompass::measured_uT(int unit, const Vector3& sent_uT,
                                                     std::optional<double> current_A) const {
  constexpr double kLeastDeterminant = 1e-3;
  constexpr int kByCurrent = 2;
  const Unit& of = units_.at(static_cast<std::size_t>(unit));
  if (!are_known(of.offset_mG) || !are_known(of.diagonal) || !are_known(of.off_diagonal)) return std::nullopt;
  const bool has_motor = motor_source_ != 0 && of.motor_mG_per_A != Vector3{};
  if (has_motor && (motor_source_ != kByCurrent || !current_A)) return std::nullopt;
  Eigen::Matrix3d d;
  d << *of.diagonal[0], *of.off_diagonal[0], *of.off_diagonal[1],  //
      *of.off_diagonal[0], *of.diagonal[1], *of.off_diagonal[2],   //
      *of.off_diagonal[1], *of.off_diagonal[2], *of.diagonal[2];
  if (d.diagonal().isZero()) d.setIdentity();  // never calibrated
  if (std::abs(d.determinant()) < kLeastDeterminant) return std::nullopt;
  Eigen::Vector3d field_mG = Eigen::Vector3d(sent_uT[0], sent_uT[1], sent_uT[2]) / kMilliGauss_uT;
  if (has_motor) field_mG -= Eigen::Map<const Eigen::Vector3d>(of.motor_mG_per_A.data()) * *current_A;
  field_mG =
      d.inverse() * field_mG / of.scale - Eigen::Vector3d(*of.offset_mG[0], *of.offset_mG[1], *of.offset_mG[2]);
  field_mG *= kMilliGauss_uT;
  return Vector3{field_mG.x(), field_mG.y(), field_mG.z()};
}

std::vector<std::string> AutopilotCompass::names(int unit) {
  const std::string number = unit == 0 ? "" : std::to_string(unit + 1);
  std::vector<std::string> names;
  const auto add_axes = [&](std::string_view kind) {
    for (const char axis : kAxes) names.push_back(std::string(kPrefix).append(kind).append(number) + '_' + axis);
  };
  add_axes("DIA");
  add_axes("ODI");
  names.emplace_back(kMotorSource);
  names.push_back("COMPASS_SCALE" + number);
  add_axes("MOT");
  add_axes("OFS");
  return names;
}

}  // namespace navcal::instruments
