// SPDX-License-Identifier: Apache-2.0
#include "instruments/mavlink_decoder.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/angles.h"

namespace navcal::instruments {

namespace mavlink = protocols::mavlink;

namespace {

constexpr std::int64_t kMs_ns = 1'000'000, kUs_ns = 1'000, kNearNewest_ns = 10'000'000'000;
constexpr std::int64_t kCounterTurn = std::int64_t{1} << 32;  // of a counter of 32 bits
constexpr std::uint64_t kUnix_us = 946'684'800'000'000;       // later: UTC, and no time since the boot
constexpr std::int64_t kFieldAgain_ns = 400'000'000;          // a field that stays the same is taken so often
constexpr std::int64_t kParameters_ns = 5'000'000'000;        // they are waited for that long
constexpr std::int64_t kHighResolution_ns = 1'000'000'000;    // without HIGHRES_IMU the others count again
constexpr double kMilliG_m_s2 = 9.80665e-3;
constexpr std::uint16_t kNoNumber = 65535;
constexpr int kHeartbeatsOfAnother = 10;
constexpr std::uint32_t kVisionDelta = 11011;

bool all_finite(const Vector3& v) { return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]); }

template <class T>
std::optional<double> unless(T absent, T raw, double step) {
  return raw != absent ? std::optional(raw * step) : std::nullopt;
}

std::optional<Vector3> if_any(const Vector3& v) {
  return all_finite(v) && v != Vector3{} ? std::optional(v) : std::nullopt;
}

}  // namespace

std::span<const MavlinkReading> MavlinkDecoder::read(const mavlink::Message& message) {
  readings_.clear();
  time_ns_.reset();
  component_ = message.component;
  const Payload payload(message.payload);
  if (message.id == 0) read_heartbeat(message, payload);
  if (message.id == kVisionDelta && vehicle_) read_delta(payload);
  if (message.system != vehicle_ || (component_ != mavlink::kAutopilot && message.id != 132)) return readings_;
  switch (message.id) {
    case 1: {
      PowerSample power;
      power.voltage_V = unless(kNoNumber, payload.at<std::uint16_t>(14), 1e-3);
      power.current_A = unless(std::int16_t{-1}, payload.at<std::int16_t>(16), 1e-2);
      if (!has_battery_status_) current_A_ = power.current_A;
      if (!has_battery_status_ && power.voltage_V) put(power);
      break;
    }
    case 22: compass_.take(payload.text(8, 16), payload.at<float>(0)); break;
    case 24: read_gps(payload); break;
    case 26: read_integers(payload, 4, 22, 0); break;
    case 27: read_integers(payload, 8, 27, 0); break;
    case 116: read_integers(payload, 4, 22, 1); break;
    case 129: read_integers(payload, 4, 22, 2); break;
    case 105: read_floats(payload); break;
    case 29:
    case 137:
    case 143:
      set_boot_ms(payload);
      take_pressure(payload.at<float>(4), payload.at<std::int16_t>(12) * 0.01,
                    int{message.id != 29} + int{message.id == 143});
      break;
    case 30: {
      const auto angles_rad = payload.vector<float>(4, 1);
      if (!all_finite(angles_rad)) break;
      CompassSample attitude;
      attitude.roll_rad = angles_rad[0];
      attitude.pitch_rad = angles_rad[1];
      attitude.heading_rad = base::as_heading(angles_rad[2]);
      attitude.heading_is_true = true;
      attitude.heading_std_rad = kAutopilotHeadingStd_rad;
      set_boot_ms(payload);
      put(attitude);
      break;
    }
    case 36: read_outputs(payload); break;
    case 147: read_battery(payload); break;
    case 132:
    case 173:
    case 11038: read_echo(message, payload); break;
    default: break;
  }
  return readings_;
}

void MavlinkDecoder::read_heartbeat(const mavlink::Message& message, const Payload& payload) {
  if (component_ != mavlink::kAutopilot || payload.at<std::uint8_t>(5) == mavlink::kNoAutopilot) return;
  others_ = vehicle_ == message.system ? 0 : others_ + 1;
  if (vehicle_ && others_ <= kHeartbeatsOfAnother) return;
  vehicle_ = message.system;
  newest_ns_.clear();
  others_ = 0;
}

void MavlinkDecoder::put(const Value& value, int instance) { readings_.push_back({value, instance, time_ns_}); }

void MavlinkDecoder::set_time(std::int64_t time_ns, std::int64_t span_ns, bool is_current) {
  const auto newest = newest_ns_.find(component_);
  const bool is_known = newest != newest_ns_.end();
  if (is_known && span_ns > 0) time_ns += (newest->second - time_ns + span_ns / 2) / span_ns * span_ns;
  if (!is_current && (!is_known || std::abs(newest->second - time_ns) >= kNearNewest_ns)) return;
  if (is_current) newest_ns_[component_] = time_ns;
  time_ns_ = time_ns;
}

void MavlinkDecoder::set_boot_ms(const Payload& payload) {
  set_time(payload.at<std::uint32_t>(0) * kMs_ns, kCounterTurn * kMs_ns, true);
}

void MavlinkDecoder::set_boot_us(const Payload& payload) {
  const auto time_us = payload.at<std::uint64_t>(0);
  if (time_us != 0 && time_us < kUnix_us) set_time(static_cast<std::int64_t>(time_us) * kUs_ns, 0, true);
}

// Accelerations in mG, rates in mrad/s, fields in mGauss; forward, starboard, down.
void MavlinkDecoder::read_integers(const Payload& payload, std::size_t first, std::size_t temperature,
                                   int instance) {
  first == 8 ? set_boot_us(payload) : set_boot_ms(payload);
  const auto& high_ns = units_.at(static_cast<std::size_t>(instance)).high_resolution_ns;
  if (high_ns && time_ns_ && std::abs(*time_ns_ - *high_ns) < kHighResolution_ns) return;
  ImuSample imu;
  imu.specific_force_m_s2 = payload.vector<std::int16_t>(first, kMilliG_m_s2);
  imu.rate_rad_s = payload.vector<std::int16_t>(first + 6, 1e-3);
  imu.temperature_C = unless(std::int16_t{0}, payload.at<std::int16_t>(temperature), 0.01);
  take(instance, imu, if_any(payload.vector<std::int16_t>(first + 12, 0.1)));
}

// HIGHRES_IMU in SI units and gauss. Versions of ArduPilot send microgauss for gauss.
void MavlinkDecoder::read_floats(const Payload& payload) {
  constexpr unsigned kForce = 0x7, kRate = 0x38, kField = 0x1C0, kPressure = 0x200;
  constexpr double kMostField_uT = 1e4;
  const auto instance = payload.at<std::uint8_t>(62);
  if (instance >= kUnits) return;
  set_boot_us(payload);
  units_.at(instance).high_resolution_ns = time_ns_;
  const unsigned updated = payload.at<std::uint16_t>(60);
  const auto is_new = [&](unsigned bits) { return (updated & bits) == bits; };
  ImuSample imu;
  if (is_new(kForce)) imu.specific_force_m_s2 = if_any(payload.vector<float>(8, 1));
  if (is_new(kRate)) imu.rate_rad_s = payload.vector<float>(20, 1);
  if (imu.rate_rad_s && !all_finite(*imu.rate_rad_s)) imu.rate_rad_s.reset();
  auto field_uT = is_new(kField) ? if_any(payload.vector<float>(32, 100)) : std::nullopt;
  if (field_uT && std::hypot((*field_uT)[0], (*field_uT)[1], (*field_uT)[2]) > kMostField_uT)
    field_uT = payload.vector<float>(32, 1e-4);
  take(instance, imu, field_uT);
  if (is_new(kPressure)) take_pressure(payload.at<float>(44), payload.at<float>(56), kPrimaryBarometer);
}

void MavlinkDecoder::take(int instance, const ImuSample& imu, const std::optional<Vector3>& field_uT) {
  if (imu.rate_rad_s || imu.specific_force_m_s2) put(imu, instance);
  Unit& unit = units_.at(static_cast<std::size_t>(instance));
  const bool is_due = !time_ns_ || std::abs(*time_ns_ - unit.field_ns) >= kFieldAgain_ns;
  if (!field_uT || (field_uT == unit.field_uT && !is_due)) return;
  unit.field_uT = field_uT;
  unit.field_ns = time_ns_.value_or(0);
  CompassSample compass;
  compass.field_body_uT = measured_uT(instance, *field_uT);
  if (compass.field_body_uT) put(compass, instance);
}

std::optional<Vector3> MavlinkDecoder::measured_uT(int instance, const Vector3& sent_uT) {
  Unit& unit = units_.at(static_cast<std::size_t>(instance));
  if (!unit.is_corrected && calibration_ != Calibration::kept) {
    if (const auto measured = compass_.measured_uT(instance, sent_uT, current_A_)) return measured;
    if (!unit.waits_since_ns) unit.waits_since_ns = time_ns_;
    if (calibration_ == Calibration::waited_for && time_ns_ &&
        std::abs(*time_ns_ - *unit.waits_since_ns) < kParameters_ns)
      return std::nullopt;
  }
  unit.is_corrected = true;
  return sent_uT;
}

void MavlinkDecoder::take_pressure(double hPa, double temperature_C, int instance) {
  if (!std::isfinite(hPa) || !std::isfinite(temperature_C)) return;
  if (hPa == 0) return put(ScalarSample{Text<24>("temperature"), Text<16>("degC"), temperature_C, {}});
  DepthSample gauge;
  gauge.pressure_Pa = hPa * 100;
  gauge.temperature_C = temperature_C;
  put(gauge, instance);
}

void MavlinkDecoder::read_gps(const Payload& payload) {
  constexpr std::uint8_t kLeast2d = 2, kLeast3d = 3, kNoCount = 255;
  const auto fix_us = payload.at<std::uint64_t>(0);
  if (fix_us != 0 && fix_us == fix_us_) return;
  fix_us_ = fix_us;
  if (fix_us < kUnix_us) set_time(static_cast<std::int64_t>(fix_us) * kUs_ns, 0, false);
  const auto quality = payload.at<std::uint8_t>(28);
  GpsSample gps;
  if (quality >= kLeast2d) {
    gps.fix = quality >= kLeast3d ? Fix::fix_3d : Fix::fix_2d;
    gps.latitude_rad = payload.at<std::int32_t>(8) * 1e-7 * base::kRadiansPerDegree;
    gps.longitude_rad = payload.at<std::int32_t>(12) * 1e-7 * base::kRadiansPerDegree;
    gps.height_msl_m = payload.at<std::int32_t>(16) * 1e-3;
    gps.dop = unless(kNoNumber, payload.at<std::uint16_t>(20), 1e-2);
    gps.speed_m_s = unless(kNoNumber, payload.at<std::uint16_t>(24), 1e-2);
    gps.course_rad = unless(kNoNumber, payload.at<std::uint16_t>(26), 1e-2 * base::kRadiansPerDegree);
    if (gps.course_rad) gps.course_rad = base::as_heading(*gps.course_rad);
    gps.position_std_m = unless(0U, payload.at<std::uint32_t>(34), 1e-3);
    gps.height_std_m = unless(0U, payload.at<std::uint32_t>(38), 1e-3);
    gps.velocity_std_m_s = unless(0U, payload.at<std::uint32_t>(42), 1e-3);
  }
  if (payload.at<std::uint8_t>(29) != kNoCount) gps.tracked = payload.at<std::uint8_t>(29);
  put(gps);
}

// The pack is the sum of its cells; ArduPilot puts the whole of it into the first.
void MavlinkDecoder::read_battery(const Payload& payload) {
  constexpr std::size_t kCells = 10, kFirst = 10;
  PowerSample power;
  for (std::size_t i = 0; i < kCells; ++i) {
    const auto cell_mV = payload.at<std::uint16_t>(kFirst + 2 * i);
    if (cell_mV != kNoNumber) power.voltage_V = power.voltage_V.value_or(0) + cell_mV * 1e-3;
  }
  power.current_A = unless(std::int16_t{-1}, payload.at<std::int16_t>(30), 1e-2);
  const int instance = payload.at<std::uint8_t>(32);
  if (instance == 0) {
    has_battery_status_ = true;
    current_A_ = power.current_A;
  }
  if (power.voltage_V || power.current_A) put(power, instance);
}

// Outputs 1 to 8 lie at 4, the port (of sixteen outputs) at 20; of version 2 outputs 9 to 16 follow.
void MavlinkDecoder::read_outputs(const Payload& payload) {
  constexpr int kOutputs = 16, kOfVersion1 = 8;
  set_time(payload.at<std::uint32_t>(0) * kUs_ns, kCounterTurn * kUs_ns, false);
  for (int i = 0; i < kOutputs; ++i) {
    const auto pulse_us =
        payload.at<std::uint16_t>(static_cast<std::size_t>(i < kOfVersion1 ? 4 + 2 * i : 5 + 2 * i));
    if (pulse_us == 0 || pulse_us == kNoNumber) continue;
    const int number = payload.at<std::uint8_t>(20) * kOutputs + i + 1;
    put(ScalarSample{Text<24>("output" + std::to_string(number)), Text<16>("us"), double(pulse_us), {}}, number);
  }
}

// VISION_POSITION_DELTA, by which drivers of Doppler logs and cameras tell an autopilot how far the vehicle has
// moved: from whoever sends it, as the autopilot takes it. Its time is of a clock that it does not name: the
// arrival counts.
void MavlinkDecoder::read_delta(const Payload& payload) {
  const double duration_s = static_cast<double>(payload.at<std::uint64_t>(8)) * 1e-6;
  const Vector3 moved_m = payload.vector<float>(28, 1);
  if (!(duration_s > 0) || !all_finite(moved_m) || !(payload.at<float>(40) > 0)) return;
  DvlSample motion;
  motion.bottom_velocity_m_s = Vector3{moved_m[0] / duration_s, moved_m[1] / duration_s, moved_m[2] / duration_s};
  put(motion);
}

// DISTANCE_SENSOR looking down, of the first component that sends it; without one RANGEFINDER and WATER_DEPTH.
void MavlinkDecoder::read_echo(const mavlink::Message& message, const Payload& payload) {
  constexpr std::uint32_t kDistanceSensor = 132, kRangefinder = 173;
  constexpr std::uint8_t kDown = 25, kInvalid = 1, kNoVariance = 255;
  AltimeterSample echo;
  bool is_good = true;
  if (message.id == kDistanceSensor) {
    if (payload.at<std::uint8_t>(12) != kDown || echo_component_.value_or(component_) != component_) return;
    echo_component_ = component_;
    set_boot_ms(payload);
    const auto distance_cm = payload.at<std::uint16_t>(8), most_cm = payload.at<std::uint16_t>(6);
    is_good = payload.at<std::uint8_t>(38) != kInvalid && (most_cm == 0 || distance_cm <= most_cm);
    echo.altitude_m = distance_cm * 0.01;
    const auto variance_cm2 = payload.at<std::uint8_t>(13);
    if (variance_cm2 != 0 && variance_cm2 != kNoVariance) echo.altitude_std_m = std::sqrt(variance_cm2) * 0.01;
  } else if (echo_component_) {
    return;
  } else if (message.id == kRangefinder) {
    echo.altitude_m = payload.at<float>(0);
  } else {
    set_boot_ms(payload);
    is_good = payload.at<std::uint8_t>(37) != 0;
    echo.altitude_m = payload.at<float>(28);
  }
  if (is_good && std::isfinite(echo.altitude_m) && echo.altitude_m > 0) put(echo);
}

}  // namespace navcal::instruments
