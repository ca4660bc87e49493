// SPDX-License-Identifier: Apache-2.0
#include "link/report.h"

#include "link/fields.h"

namespace navcal::link {
namespace {

constexpr std::uint8_t kReportVersion = 1;
constexpr std::uint8_t kNorthTrue = 1;
constexpr std::uint8_t kHasTime = 2;
constexpr std::size_t kShortHolderBytes = 12;
constexpr std::size_t kCalibratorBytes = 16;

// Units of the fields.
constexpr double kCentidegree = 0.01;
constexpr double kMillimetre = 0.001;
constexpr double kPlace = 1e-7;
constexpr double kTenth = 0.1;
constexpr double kHundredth = 0.01;

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

Buffer encode_report(const Report& r) {
  FieldWriter out;
  out.put(kReportVersion);
  out.put(static_cast<std::uint8_t>((r.is_north_true ? kNorthTrue : 0) | (r.time_utc_ms ? kHasTime : 0)));
  const auto time = static_cast<std::uint64_t>(r.time_utc_ms.value_or(0));
  out.put(static_cast<std::uint16_t>(time >> 32));
  out.put(static_cast<std::uint32_t>(time));
  out.put_scaled<std::uint16_t>(r.heading_deg, kCentidegree);
  out.put_scaled<std::int16_t>(r.pitch_deg, kCentidegree);
  out.put_scaled<std::int16_t>(r.roll_deg, kCentidegree);
  for (const auto& rate : r.rate_deg_s) out.put_scaled<std::int16_t>(rate, kCentidegree);
  out.put_scaled<std::int32_t>(r.depth_m, kMillimetre);
  out.put_scaled<std::int32_t>(r.latitude_deg, kPlace);
  out.put_scaled<std::int32_t>(r.longitude_deg, kPlace);
  out.put_scaled<std::uint16_t>(r.position_std_m, kTenth);
  out.put_scaled<std::uint16_t>(r.heading_std_deg, kCentidegree);
  out.put_scaled<std::uint16_t>(r.depth_std_m, kMillimetre);
  out.put_scaled<std::int16_t>(r.speed_m_s, kMillimetre);
  out.put_scaled<std::int16_t>(r.climb_m_s, kMillimetre);
  out.put_scaled<std::int16_t>(r.shaft_rpm, 1);
  for (const auto& fin : r.fins_deg) out.put_scaled<std::int16_t>(fin, kCentidegree);
  for (const auto& age : {r.compass_age_s, r.imu_age_s, r.gps_age_s, r.motor_age_s})
    out.put_scaled<std::uint8_t>(age, kTenth);
  out.put(r.alarms);
  out.put(r.order_sequence);
  out.put_scaled<std::uint16_t>(r.battery_V, kHundredth);
  out.put_scaled<std::uint8_t>(r.battery_charge, kHundredth);
  out.put(r.priority);
  out.put_scaled<std::uint16_t>(r.expires_in_s, kHundredth);
  out.put_text(r.holder, kShortHolderBytes);
  if (r.calibration) {
    out.put_text(r.calibration->calibrator, kCalibratorBytes);
    out.put(r.calibration->verdict);
    out.put(r.calibration->number);
    out.put(r.calibration->hash);
  }
  return std::move(out).take();
}

std::optional<Report> decode_report(Bytes payload) {
  FieldReader in(payload);
  if (in.get<std::uint8_t>() != kReportVersion) return std::nullopt;
  Report r;
  const auto flags = in.get<std::uint8_t>();
  r.is_north_true = (flags & kNorthTrue) != 0;
  const std::uint64_t high = in.get<std::uint16_t>();
  const std::uint64_t time = high << 32 | in.get<std::uint32_t>();
  if ((flags & kHasTime) != 0) r.time_utc_ms = static_cast<std::int64_t>(time);
  r.heading_deg = in.get_scaled<std::uint16_t>(kCentidegree);
  r.pitch_deg = in.get_scaled<std::int16_t>(kCentidegree);
  r.roll_deg = in.get_scaled<std::int16_t>(kCentidegree);
  for (auto& rate : r.rate_deg_s) rate = in.get_scaled<std::int16_t>(kCentidegree);
  r.depth_m = in.get_scaled<std::int32_t>(kMillimetre);
  r.latitude_deg = in.get_scaled<std::int32_t>(kPlace);
  r.longitude_deg = in.get_scaled<std::int32_t>(kPlace);
  r.position_std_m = in.get_scaled<std::uint16_t>(kTenth);
  r.heading_std_deg = in.get_scaled<std::uint16_t>(kCentidegree);
  r.depth_std_m = in.get_scaled<std::uint16_t>(kMillimetre);
  r.speed_m_s = in.get_scaled<std::int16_t>(kMillimetre);
  r.climb_m_s = in.get_scaled<std::int16_t>(kMillimetre);
  r.shaft_rpm = in.get_scaled<std::int16_t>(1);
  for (auto& fin : r.fins_deg) fin = in.get_scaled<std::int16_t>(kCentidegree);
  for (auto* age : {&r.compass_age_s, &r.imu_age_s, &r.gps_age_s, &r.motor_age_s})
    *age = in.get_scaled<std::uint8_t>(kTenth);
  r.alarms = in.get<std::uint16_t>();
  r.order_sequence = in.get<std::uint16_t>();
  r.battery_V = in.get_scaled<std::uint16_t>(kHundredth);
  r.battery_charge = in.get_scaled<std::uint8_t>(kHundredth);
  r.priority = in.get<std::uint16_t>();
  r.expires_in_s = in.get_scaled<std::uint16_t>(kHundredth);
  r.holder = in.get_text();
  if (!in.is_whole()) return std::nullopt;
  if (in.rest().empty()) return r;
  CalibrationState calibration;
  calibration.calibrator = in.get_text();
  calibration.verdict = in.get<std::uint8_t>();
  calibration.number = in.get<std::uint16_t>();
  calibration.hash = in.get<std::uint32_t>();
  if (!in.is_whole()) return std::nullopt;
  r.calibration = calibration;
  return r;
}

}  // namespace navcal::link
