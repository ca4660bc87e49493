// SPDX-License-Identifier: Apache-2.0
#include "protocols/vectornav_lines.h"

#include <array>

#include "protocols/checked_line.h"
#include "protocols/decimal.h"
#include "protocols/text_fields.h"

namespace navcal::protocols::vectornav {
namespace {

constexpr double kLineGauss_uT = 100, kLineKilopascal_Pa = 1000;

template <std::size_t N>
Triple three(const std::array<double, N>& values, std::size_t from, double unit = 1) {
  return {values[from] * unit, values[from + 1] * unit, values[from + 2] * unit};
}

std::optional<Reading> read_ymr(std::string_view fields) {
  const auto v = numbers<12>(fields);
  if (!v) return std::nullopt;
  Reading reading;
  reading.yaw_pitch_roll_deg = three(*v, 0);
  reading.field_uT = three(*v, 3, kLineGauss_uT);
  reading.acceleration_m_s2 = three(*v, 6);
  reading.rate_rad_s = three(*v, 9);
  return reading;
}

std::optional<Reading> read_imu_line(std::string_view fields) {
  const auto v = numbers<11>(fields);
  if (!v) return std::nullopt;
  Reading reading;
  reading.raw_field_uT = three(*v, 0, kLineGauss_uT);
  reading.raw_acceleration_m_s2 = three(*v, 3);
  reading.raw_rate_rad_s = three(*v, 6);
  reading.temperature_C = (*v)[9];
  reading.pressure_Pa = (*v)[10] * kLineKilopascal_Pa;
  return reading;
}

std::optional<Reading> read_mar(std::string_view fields) {
  const auto v = numbers<9>(fields);
  if (!v) return std::nullopt;
  Reading reading;
  reading.field_uT = three(*v, 0, kLineGauss_uT);
  reading.acceleration_m_s2 = three(*v, 3);
  reading.rate_rad_s = three(*v, 6);
  return reading;
}

std::optional<Reading> read_three(std::string_view fields, std::optional<Triple> Reading::*member, double unit) {
  const auto v = numbers<3>(fields);
  if (!v) return std::nullopt;
  Reading reading;
  reading.*member = three(*v, 0, unit);
  return reading;
}

}  // namespace

std::optional<Reading> decode_line(Bytes frame) {
  const std::string_view body = body_of(frame);
  const std::size_t comma = body.find(',');
  if (comma == std::string_view::npos) return std::nullopt;
  const std::string_view name = body.substr(0, comma), fields = body.substr(comma + 1);
  if (name == "VNYMR") return read_ymr(fields);
  if (name == "VNIMU") return read_imu_line(fields);
  if (name == "VNMAR") return read_mar(fields);
  if (name == "VNYPR") return read_three(fields, &Reading::yaw_pitch_roll_deg, 1);
  if (name == "VNMAG") return read_three(fields, &Reading::field_uT, kLineGauss_uT);
  if (name == "VNACC") return read_three(fields, &Reading::acceleration_m_s2, 1);
  if (name == "VNGYR") return read_three(fields, &Reading::rate_rad_s, 1);
  return std::nullopt;
}

std::vector<std::uint8_t> encode_line(const Reading& reading) {
  std::string body = "VNYMR";
  const auto append = [&](const std::optional<Triple>& values, double unit, int decimals) {
    for (const double value : values.value_or(Triple{})) {
      body += ',';
      append_decimal(body, value / unit, decimals);
    }
  };
  append(reading.yaw_pitch_roll_deg, 1, 3);
  append(reading.field_uT, kLineGauss_uT, 4);
  append(reading.acceleration_m_s2, 1, 3);
  append(reading.rate_rad_s, 1, 6);
  return checked_line(body);
}

std::optional<Register> decode_register(Bytes frame) {
  std::string_view body = body_of(frame);
  Register content;
  content.write = body.starts_with("VNWRG,");
  if (!content.write && !body.starts_with("VNRRG,")) return std::nullopt;
  body.remove_prefix(6);
  const std::size_t comma = body.find(',');
  const auto number = integer<unsigned>(body.substr(0, comma));
  if (!number) return std::nullopt;
  content.number = *number;
  if (comma != std::string_view::npos) content.values = body.substr(comma + 1);
  return content;
}

std::vector<std::uint8_t> encode_register(const Register& content) {
  std::string body = content.write ? "VNWRG," : "VNRRG,";
  if (content.number < 10) body += '0';
  body += std::to_string(content.number);
  if (!content.values.empty()) body += ',' + content.values;
  return checked_line(body);
}

std::optional<std::uint8_t> decode_error(Bytes frame) {
  std::string_view body = body_of(frame);
  if (!body.starts_with("VNERR,")) return std::nullopt;
  body.remove_prefix(6);
  return integer<std::uint8_t>(body, 16);
}

std::vector<std::uint8_t> encode_error(std::uint8_t code) {
  std::string body = "VNERR,";
  append_hex(body, code, 2);
  return checked_line(body);
}

std::string_view meaning_of(std::uint8_t error) {
  constexpr std::array<std::string_view, 13> kMeanings{"none",
                                                       "hard fault",
                                                       "serial buffer overflow",
                                                       "invalid checksum",
                                                       "invalid command",
                                                       "not enough parameters",
                                                       "too many parameters",
                                                       "invalid parameter",
                                                       "invalid register",
                                                       "unauthorized access",
                                                       "watchdog reset",
                                                       "output buffer overflow",
                                                       "insufficient baud rate"};
  if (error == 0xFF) return "error buffer overflow";
  // Whether the code is decimal or hexadecimal is not certain: the decimal ones from 10 on mean nothing else.
  const std::size_t code = error >= 0x10 && error <= 0x12 ? error - 6U : error;
  return code < kMeanings.size() ? kMeanings.at(code) : "unknown";
}

}  // namespace navcal::protocols::vectornav
