// SPDX-License-Identifier: Apache-2.0
#include "analysis/import/mavlink_log.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>

#include "analysis/import/mavlink_frame.h"
#include "analysis/import/port_name.h"
#include "analysis/import/servo_parameters.h"
#include "analysis/import/wire_reader.h"
#include "base/angles.h"

namespace navcal::analysis {
namespace {

using mavlink::Frame;
using protocols::samples_line::LineWriter;

constexpr std::size_t kTime_bytes = 8;
constexpr std::uint64_t kFirst_us = 946'684'800'000'000;   // 2000
constexpr std::uint64_t kLast_us = 4'102'444'800'000'000;  // 2100

std::uint64_t time_us_at(std::string_view bytes) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < kTime_bytes; ++i) value = value << 8 | static_cast<std::uint8_t>(bytes[i]);
  return value;
}

/// A payload as it was before the zeros at its end were left out.
class Payload {
 public:
  explicit Payload(std::string_view sent) {
    std::copy_n(sent.begin(), std::min(sent.size(), bytes_.size()), bytes_.begin());
  }
  template <class T>
  [[nodiscard]] double at(std::size_t offset) const {
    return static_cast<double>(little_endian_at<T>({bytes_.data(), bytes_.size()}, offset));
  }
  template <class T>
  [[nodiscard]] std::array<double, 3> vector(std::size_t offset, double factor) const {
    return {factor * at<T>(offset), factor * at<T>(offset + sizeof(T)), factor * at<T>(offset + 2 * sizeof(T))};
  }

 private:
  std::array<char, 256> bytes_{};
};

class MavlinkFile {
 public:
  MavlinkFile(std::string_view file, ImportSink& sink, MotorChannels& channels)
      : file_(file), sink_(sink), channels_(channels) {}
  ImportFindings read();

 private:
  void take(const Frame& frame, std::int64_t time_ns);
  void take_known(const Frame& frame, ImportedSample sample);
  void take_imu(const Payload& payload, std::size_t first, int instance, ImportedSample sample);
  void take_gps(const Payload& payload, bool has_errors, ImportedSample sample);
  void take_parameter(const Payload& payload);
  void take_servos(const Payload& payload, ImportedSample sample);

  std::string_view file_;
  ImportSink& sink_;
  MotorChannels& channels_;
  ServoParameters servos_;
  ImportFindings findings_;
  std::optional<std::uint8_t> vehicle_;
};

ImportFindings MavlinkFile::read() {
  constexpr std::size_t kProgressBytes = 1 << 16;
  findings_.times_are_utc = true;
  std::size_t at = 0, told = 0;
  while (at < file_.size()) {
    const std::string_view rest = file_.substr(at);
    if (rest.size() < kTime_bytes) {
      findings_.cut_at = at;
      break;
    }
    const std::uint64_t time_us = time_us_at(rest);
    const auto found = time_us >= kFirst_us && time_us < kLast_us ? mavlink::find_frame(rest.substr(kTime_bytes))
                                                                  : mavlink::Found{};
    if (found.verdict == mavlink::Verdict::incomplete) {
      findings_.cut_at = at;
      break;
    }
    if (found.verdict == mavlink::Verdict::no_frame) {
      ++findings_.damaged_bytes;
      ++at;
      continue;
    }
    take(found.frame, static_cast<std::int64_t>(time_us) * 1000);
    at += kTime_bytes + found.frame.length;
    if (at - told >= kProgressBytes) sink_.progress(told = at);
  }
  if (std::string words = servos_.words(); !words.empty()) findings_.remarks.push_back(std::move(words));
  return std::move(findings_);
}

void MavlinkFile::take(const Frame& frame, std::int64_t time_ns) {
  if (frame.message == nullptr) return sink_.left(fmt::format("message {}", frame.id));
  constexpr std::uint32_t kParameter = 22;
  if (frame.id == kParameter) take_parameter(Payload(frame.payload));
  constexpr std::array<std::uint32_t, 12> kTaken{1, 24, 26, 27, 29, 30, 36, 116, 129, 137, 143, 2};
  if (std::find(kTaken.begin(), kTaken.end(), frame.id) == kTaken.end()) return sink_.left(frame.message->name);
  if (!vehicle_) vehicle_ = frame.system;
  if (*vehicle_ != frame.system)
    return sink_.left(fmt::format("{} (of system {})", frame.message->name, frame.system));
  take_known(frame, {frame.message->name, {}, time_ns});
}

void MavlinkFile::take_known(const Frame& frame, ImportedSample sample) {
  const Payload payload(frame.payload);
  switch (frame.id) {
    case 26: return take_imu(payload, 4, 0, sample);
    case 27: return take_imu(payload, 8, 0, sample);
    case 116: return take_imu(payload, 4, 1, sample);
    case 129: return take_imu(payload, 4, 2, sample);
    case 24: {
      constexpr std::size_t kWithoutErrors = 34;
      return take_gps(payload, frame.payload.size() > kWithoutErrors, sample);
    }
    case 36: return take_servos(payload, sample);
    case 29:
    case 137:
    case 143: {
      LineWriter line("DEPTH");
      line.number("pressure_Pa", payload.at<float>(4) * 100)
          .number("temperature_C", payload.at<std::int16_t>(12) * 0.01);
      sample.port = port_name(PortKind::baro, frame.id == 29 ? 0 : frame.id == 137 ? 1 : 2);
      return sink_.sample(sample, line);
    }
    case 30: {
      LineWriter line("COMPASS");
      line.number("heading_rad", base::as_heading(payload.at<float>(12))).boolean("heading_is_true", true);
      line.number("pitch_rad", payload.at<float>(8)).number("roll_rad", payload.at<float>(4));
      sample.port = port_name(PortKind::attitude, 0);
      return sink_.sample(sample, line);
    }
    case 1: {
      constexpr double kUnknown_mV = 65535;
      if (payload.at<std::uint16_t>(14) == kUnknown_mV) return sink_.left("SYS_STATUS (voltage not known)");
      LineWriter line("POWER");
      line.number("voltage_V", payload.at<std::uint16_t>(14) * 1e-3);
      if (payload.at<std::int16_t>(16) != -1) line.number("current_A", payload.at<std::int16_t>(16) * 1e-2);
      sample.port = port_name(PortKind::battery, 0);
      return sink_.sample(sample, line);
    }
    default: {
      const double unix_us = payload.at<std::uint64_t>(0);
      if (unix_us >= static_cast<double>(kFirst_us) && findings_.remarks.empty()) {
        const double ahead_s = static_cast<double>(sample.time_ns) * 1e-9 - unix_us * 1e-6;
        constexpr double kLarge_s = 2;
        if (std::abs(ahead_s) > kLarge_s)
          findings_.remarks.push_back(fmt::format(
              "the clock of the computer that wrote this file is {:.1f} s ahead of the vehicle's (SYSTEM_TIME)",
              ahead_s));
      }
      return sink_.left("SYSTEM_TIME (compared with the file's times)");
    }
  }
}

// Accelerations in mG, rates in mrad/s, fields in mGauss; forward, starboard, down.
void MavlinkFile::take_imu(const Payload& payload, std::size_t first, int instance, ImportedSample sample) {
  constexpr double kMilliG_m_s2 = 9.80665e-3;
  LineWriter line("IMU");
  line.vector("rate_rad_s", payload.vector<std::int16_t>(first + 6, 1e-3));
  line.vector("specific_force_m_s2", payload.vector<std::int16_t>(first, kMilliG_m_s2));
  sample.port = port_name(PortKind::imu, instance);
  sink_.sample(sample, line);
  const auto field_uT = payload.vector<std::int16_t>(first + 12, 0.1);
  if (field_uT == std::array<double, 3>{}) return;  // no magnetometer
  LineWriter compass("COMPASS");
  compass.vector("field_body_uT", field_uT);
  sample.port = port_name(PortKind::compass, instance);
  sink_.sample(sample, compass);
}

void MavlinkFile::take_gps(const Payload& payload, bool has_errors, ImportedSample sample) {
  constexpr double kUnknown = 65535, kLeast2d = 2, kLeast3d = 3;
  const double quality = payload.at<std::uint8_t>(28);
  LineWriter line("GPS");
  line.text("fix", quality >= kLeast3d ? "3d" : quality == kLeast2d ? "2d" : "none");
  if (quality >= kLeast2d) {
    line.number("lat", payload.at<std::int32_t>(8) * 1e-7).number("lon", payload.at<std::int32_t>(12) * 1e-7);
    line.number("height_msl_m", payload.at<std::int32_t>(16) * 1e-3);
    if (payload.at<std::uint16_t>(20) != kUnknown) line.number("dop", payload.at<std::uint16_t>(20) * 1e-2);
    if (payload.at<std::uint16_t>(24) != kUnknown) line.number("speed_m_s", payload.at<std::uint16_t>(24) * 1e-2);
    if (payload.at<std::uint16_t>(26) != kUnknown)
      line.number("course_rad", base::as_heading(payload.at<std::uint16_t>(26) * 1e-2 * base::kRadiansPerDegree));
    if (has_errors) {
      line.number("position_std_m", payload.at<std::uint32_t>(34) * 1e-3);
      line.number("height_std_m", payload.at<std::uint32_t>(38) * 1e-3);
      line.number("velocity_std_m_s", payload.at<std::uint32_t>(42) * 1e-3);
    }
  }
  if (payload.at<std::uint8_t>(29) != 255) line.number("tracked", payload.at<std::uint8_t>(29));
  sample.port = port_name(PortKind::gps, 0);
  sink_.sample(sample, line);
}

// PARAM_VALUE: the number, and a name of at most 16 characters.
void MavlinkFile::take_parameter(const Payload& payload) {
  constexpr std::size_t kName = 8, kName_bytes = 16;
  std::string name;
  for (std::size_t i = 0; i < kName_bytes; ++i) {
    const char c = static_cast<char>(payload.at<std::int8_t>(kName + i));
    if (c == '\0') break;
    name += c;
  }
  servos_.take(name, payload.at<float>(0));
}

// Outputs 1 to 8 lie at 4, the port (of eight outputs each) at 20; of version 2 outputs 9 to 16 follow.
void MavlinkFile::take_servos(const Payload& payload, ImportedSample sample) {
  constexpr std::size_t kServos = 8, kFirst = 4, kPort = 20, kMore = 21;
  sample.port = port_name(PortKind::motor, 0);
  const auto bank = static_cast<std::size_t>(payload.at<std::uint8_t>(kPort));
  std::array<double, 2 * kServos> pulses_us{};
  for (std::size_t i = 0; i < kServos; ++i) {
    pulses_us[i] = payload.at<std::uint16_t>(kFirst + 2 * i);
    pulses_us[kServos + i] = bank == 0 ? payload.at<std::uint16_t>(kMore + 2 * i) : 0;
  }
  const auto name_of = [&](std::size_t i) { return fmt::format("servo{}_raw", bank * kServos + i + 1); };
  const auto read = [&](std::string_view member) -> std::optional<double> {
    for (std::size_t i = 0; i < pulses_us.size(); ++i) {
      if (pulses_us[i] != 0 && name_of(i) == member) return pulses_us[i];
    }
    return std::nullopt;
  };
  const bool is_mapped = channels_.emit(sample.message, read, sample, sink_);
  for (std::size_t i = 0; i < pulses_us.size(); ++i) {
    if (pulses_us[i] == 0 || channels_.has(sample.message, name_of(i))) continue;
    LineWriter line("SENSOR");
    line.text("quantity", fmt::format("output{}", bank * kServos + i + 1))
        .text("unit", "us")
        .number("value", pulses_us[i]);
    sink_.sample(sample, line);
    sample.continues = true;
  }
  if (!sample.continues && !is_mapped) sink_.left("SERVO_OUTPUT_RAW (no output in use)");
}

}  // namespace

bool is_mavlink_log(std::string_view head) {
  if (head.size() <= kTime_bytes) return false;
  const std::uint64_t time_us = time_us_at(head);
  if (time_us < kFirst_us || time_us >= kLast_us) return false;
  const auto found = mavlink::find_frame(head.substr(kTime_bytes));
  return found.verdict == mavlink::Verdict::frame;
}

ImportFindings read_mavlink_log(std::string_view file, ImportSink& sink, MotorChannels& channels) {
  return MavlinkFile(file, sink, channels).read();
}

}  // namespace navcal::analysis
