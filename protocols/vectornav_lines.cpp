// SPDX-License-Identifier: Apache-2.0
#include "protocols/vectornav_lines.h"

#include <algorithm>
#include <array>

#include "protocols/checked_line.h"
#include "protocols/decimal.h"
#include "protocols/text_fields.h"

namespace navcal::protocols::vectornav {
namespace {

constexpr double kLineGauss_uT = 100, kLineKilopascal_Pa = 1000;

struct Part {
  std::optional<Triple> Reading::*member = nullptr;
  double unit = 1;
};
/// The triples of a line, in their order.
struct LineForm {
  std::string_view name;
  std::array<Part, 4> parts{};
};
using R = Reading;
constexpr LineForm kForms[] = {
    {"VNYMR",
     {{{&R::yaw_pitch_roll_deg}, {&R::field_uT, kLineGauss_uT}, {&R::acceleration_m_s2}, {&R::rate_rad_s}}}},
    {"VNIMU", {{{&R::raw_field_uT, kLineGauss_uT}, {&R::raw_acceleration_m_s2}, {&R::raw_rate_rad_s}}}},
    {"VNMAR", {{{&R::field_uT, kLineGauss_uT}, {&R::acceleration_m_s2}, {&R::rate_rad_s}}}},
    {"VNYPR", {{{&R::yaw_pitch_roll_deg}}}},
    {"VNMAG", {{{&R::field_uT, kLineGauss_uT}}}},
    {"VNACC", {{{&R::acceleration_m_s2}}}},
    {"VNGYR", {{{&R::rate_rad_s}}}},
};

}  // namespace

std::optional<Reading> decode_line(Bytes frame) {
  LineReader line(body_of(frame));
  const std::string_view name = line.take();
  const auto* const form = std::ranges::find_if(kForms, [&](const LineForm& one) { return one.name == name; });
  if (form == std::end(kForms)) return std::nullopt;
  Reading reading;
  for (const auto& [member, unit] : form->parts) {
    if (member == nullptr) continue;
    line.number((reading.*member).emplace());
    for (double& value : *(reading.*member)) value *= unit;
  }
  if (form->name == "VNIMU") {
    line.number(reading.temperature_C.emplace());
    line.number(reading.pressure_Pa.emplace());
    *reading.pressure_Pa *= kLineKilopascal_Pa;
  }
  return line.are_good() ? std::optional(reading) : std::nullopt;
}

std::vector<std::uint8_t> encode_line(const Reading& reading) {
  LineWriter line(kForms[0].name);
  constexpr int kDecimals[] = {3, 4, 3, 6};
  for (std::size_t i = 0; i < std::size(kDecimals); ++i) {
    const auto& [member, unit] = kForms[0].parts[i];
    for (const double value : (reading.*member).value_or(Triple{})) line.number(value / unit, Print{kDecimals[i]});
  }
  return checked_line(line.line());
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
