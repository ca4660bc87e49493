// SPDX-License-Identifier: Apache-2.0
#include "link/report.h"

#include "link/fields.h"

namespace navcal::link {
namespace {

constexpr std::uint8_t kReportVersion = 1;
constexpr std::size_t kShortHolderBytes = 12;
constexpr std::size_t kCalibratorBytes = 16;

// Units of the fields.
constexpr double kCentidegree = 0.01;
constexpr double kMillimetre = 0.001;
constexpr double kPlace = 1e-7;
constexpr double kTenth = 0.1;
constexpr double kHundredth = 0.01;

/// All behind the time, but for the state of a calibrator.
template <class Fields>
void lay_out_report(Fields& fields, auto& r) {
  const auto centidegrees = [&](auto& angle) { fields.template scaled<std::int16_t>(angle, kCentidegree); };
  fields.template scaled<std::uint16_t>(r.heading_deg, kCentidegree);
  centidegrees(r.pitch_deg);
  centidegrees(r.roll_deg);
  for (auto& rate : r.rate_deg_s) centidegrees(rate);
  fields.template scaled<std::int32_t>(r.depth_m, kMillimetre);
  fields.template scaled<std::int32_t>(r.latitude_deg, kPlace);
  fields.template scaled<std::int32_t>(r.longitude_deg, kPlace);
  fields.template scaled<std::uint16_t>(r.position_std_m, kTenth);
  fields.template scaled<std::uint16_t>(r.heading_std_deg, kCentidegree);
  fields.template scaled<std::uint16_t>(r.depth_std_m, kMillimetre);
  fields.template scaled<std::int16_t>(r.speed_m_s, kMillimetre);
  fields.template scaled<std::int16_t>(r.climb_m_s, kMillimetre);
  fields.template scaled<std::int16_t>(r.shaft_rpm, 1);
  for (auto& fin : r.fins_deg) centidegrees(fin);
  for (auto* age : {&r.compass_age_s, &r.imu_age_s, &r.gps_age_s, &r.motor_age_s})
    fields.template scaled<std::uint8_t>(*age, kTenth);
  fields.number(r.alarms);
  fields.number(r.order_sequence);
  fields.template scaled<std::uint16_t>(r.battery_V, kHundredth);
  fields.template scaled<std::uint8_t>(r.battery_charge, kHundredth);
  fields.number(r.priority);
  fields.template scaled<std::uint16_t>(r.expires_in_s, kHundredth);
  fields.text(r.holder, kShortHolderBytes);
}

void lay_out_calibration(auto& fields, auto& calibration) {
  fields.text(calibration.calibrator, kCalibratorBytes);
  fields.number(calibration.verdict);
  fields.number(calibration.number);
  fields.number(calibration.hash);
}

}  // namespace

std::vector<std::string_view> Report::alarm_names() const {
  std::vector<std::string_view> names;
  for (std::size_t i = 0; i < kAlarmNames.size(); ++i) {
    if ((alarms >> i & 1U) != 0) names.push_back(kAlarmNames.at(i));
  }
  if ((alarms >> kOtherAlarmBit & 1U) != 0) names.emplace_back("other");
  return names;
}

void Report::set_alarm(std::string_view name) {
  unsigned bit = kOtherAlarmBit;
  for (unsigned i = 0; i < kAlarmNames.size(); ++i) {
    if (kAlarmNames.at(i) == name) bit = i;
  }
  alarms = static_cast<std::uint16_t>(alarms | 1U << bit);
}

Buffer encode_report(const Report& report) {
  FieldWriter out;
  out.put(kReportVersion);
  out.flags(report.is_north_true, report.time_utc_ms.has_value());
  const auto time = static_cast<std::uint64_t>(report.time_utc_ms.value_or(0));
  out.put(static_cast<std::uint16_t>(time >> 32));
  out.put(static_cast<std::uint32_t>(time));
  lay_out_report(out, report);
  if (report.calibration) lay_out_calibration(out, *report.calibration);
  return std::move(out).take();
}

std::optional<Report> decode_report(Bytes payload) {
  FieldReader in(payload);
  if (in.get<std::uint8_t>() != kReportVersion) return std::nullopt;
  Report report;
  bool has_time = false;
  in.flags(report.is_north_true, has_time);
  const std::uint64_t high = in.get<std::uint16_t>();
  const std::uint64_t time = high << 32 | in.get<std::uint32_t>();
  if (has_time) report.time_utc_ms = static_cast<std::int64_t>(time);
  lay_out_report(in, report);
  if (!in.is_whole()) return std::nullopt;
  if (!in.rest().empty()) lay_out_calibration(in, report.calibration.emplace());
  return in.is_whole() ? std::optional(std::move(report)) : std::nullopt;
}

}  // namespace navcal::link
