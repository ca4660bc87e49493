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
  std::string_view rest = body_of(frame);
  const auto take = [&rest] {
    const std::size_t comma = std::min(rest.find(','), rest.size());
    const std::string_view field = rest.substr(0, comma);
    rest.remove_prefix(std::min(comma + 1, rest.size()));
    return field;
  };
  if (rest.ends_with(',')) return std::nullopt;
  const std::string_view name = take();
  const auto* const form = std::ranges::find_if(kForms, [&](const LineForm& one) { return one.name == name; });
  if (form == std::end(kForms)) return std::nullopt;
  bool is_good = true;
  const auto number = [&] {
    const auto value = signed_number(take());
    is_good = is_good && value;
    return value.value_or(0);
  };
  Reading reading;
  for (const auto& [member, unit] : form->parts) {
    if (member == nullptr) continue;
    for (double& value : (reading.*member).emplace()) value = number() * unit;
  }
  if (form->name == "VNIMU") {
    reading.temperature_C = number();
    reading.pressure_Pa = number() * kLineKilopascal_Pa;
  }
  return is_good && rest.empty() ? std::optional(reading) : std::nullopt;
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
