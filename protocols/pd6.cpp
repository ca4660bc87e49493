// SPDX-License-Identifier: Apache-2.0
#include "protocols/pd6.h"

#include <cmath>
#include <string>
#include <string_view>

#include "protocols/decimal.h"
#include "protocols/text_fields.h"

namespace navcal::protocols::pd6 {
namespace {

constexpr std::array kLines{kAttitude,       kTiming,          kBottomInstrument, kBottomShip, kBottomEarth,
                            kBottomDistance, kWaterInstrument, kWaterShip,        kWaterEarth, kWaterDistance};
constexpr std::size_t kNameEnd = 3;  // behind the colon and two letters
constexpr double kNone_mm_s = 32768, kMillimetre_m = 1e-3;

bool may_be_in_a_line(std::uint8_t byte) {
  return (byte >= '0' && byte <= '9') || byte == '+' || byte == '-' || byte == '.' || byte == ',' || byte == ' ' ||
         byte == 'A' || byte == 'V' || byte == 'I';
}

/// Text behind the comma of a line with this name.
std::optional<std::string_view> fields_text(Bytes frame, FrameId line) {
  std::string_view text(reinterpret_cast<const char*>(frame.data()), frame.size());
  if (text.size() < kNameEnd + 1 || text.substr(1, 2) != line.view()) return std::nullopt;
  text.remove_prefix(kNameEnd + 1);
  while (text.ends_with('\n') || text.ends_with('\r')) text.remove_suffix(1);
  return text;
}

/// A velocity field; `value` stays absent for no value. False when the field is not a number.
bool read_velocity(std::string_view field, std::optional<double>& value_m_s) {
  const auto value_mm_s = signed_number(field);
  if (value_mm_s && std::abs(*value_mm_s) < kNone_mm_s) value_m_s = *value_mm_s * kMillimetre_m;
  return value_mm_s.has_value();
}

void append_padded(std::string& line, double value, std::size_t digits, int decimals, bool sign) {
  std::string text;
  append_decimal(text, std::abs(value), decimals);
  line += ',';
  if (sign) line += value < 0 ? '-' : '+';
  const std::size_t width = digits + (decimals > 0 ? static_cast<std::size_t>(decimals) + 1 : 0);
  if (text.size() < width) line.append(width - text.size(), '0');
  line += text;
}

void append_velocity(std::string& line, const std::optional<double>& value_m_s) {
  if (value_m_s) {
    append_padded(line, *value_m_s / kMillimetre_m, 5, 0, true);
  } else {
    line += ",-32768";
  }
}

std::string begin(FrameId line) { return ':' + std::string(line.view()); }
std::vector<std::uint8_t> ended(std::string line) {
  line += "\r\n";
  return {line.begin(), line.end()};
}

bool is_instrument(FrameId line) { return line == kBottomInstrument || line == kWaterInstrument; }

}  // namespace

Scan Scanner::scan(const std::uint8_t* first, const std::uint8_t* last) {
  const auto available = std::min(static_cast<std::size_t>(last - first), kMaxFrameLength);
  FrameId id;
  if (available > 1 && std::none_of(kLines.begin(), kLines.end(),
                                    [&](FrameId line) { return line.view()[0] == static_cast<char>(first[1]); })) {
    return Scan::not_a_frame();
  }
  if (available > 2) {
    id = FrameId(std::string_view(reinterpret_cast<const char*>(first) + 1, 2));
    if (std::find(kLines.begin(), kLines.end(), id) == kLines.end()) return Scan::not_a_frame();
  }
  if (available > kNameEnd && first[kNameEnd] != ',') return Scan::not_a_frame();
  for (std::size_t i = kNameEnd + 1; i < available; ++i) {
    if (may_be_in_a_line(first[i])) continue;
    if (first[i] == '\n') return Scan::frame(i + 1, id);
    if (first[i] != '\r') return Scan::not_a_frame();
    if (i + 1 == kMaxFrameLength) return Scan::not_a_frame();
    if (i + 1 == available) return Scan::incomplete(1);
    return first[i + 1] == '\n' ? Scan::frame(i + 2, id) : Scan::not_a_frame();
  }
  return available == kMaxFrameLength ? Scan::not_a_frame() : Scan::incomplete(1);
}

std::optional<Attitude> decode_attitude(Bytes frame) {
  const auto text = fields_text(frame, kAttitude);
  const auto values = text ? numbers<3>(*text) : std::nullopt;
  if (!values) return std::nullopt;
  return Attitude{(*values)[0], (*values)[1], (*values)[2]};
}

std::optional<Velocity> decode_velocity(Bytes frame) {
  for (const FrameId line :
       {kBottomInstrument, kBottomShip, kBottomEarth, kWaterInstrument, kWaterShip, kWaterEarth}) {
    const auto text = fields_text(frame, line);
    if (!text) continue;
    std::string_view status;
    Velocity velocity{line, {}, {}, false};
    if (is_instrument(line)) {
      const auto f = split_exactly<5>(*text);
      if (!f || !read_velocity((*f)[3], velocity.error_velocity_m_s)) return std::nullopt;
      status = (*f)[4];
      for (std::size_t i = 0; i < 3; ++i) {
        if (!read_velocity((*f)[i], velocity.velocity_m_s[i])) return std::nullopt;
      }
    } else {
      const auto f = split_exactly<4>(*text);
      if (!f) return std::nullopt;
      status = (*f)[3];
      for (std::size_t i = 0; i < 3; ++i) {
        if (!read_velocity((*f)[i], velocity.velocity_m_s[i])) return std::nullopt;
      }
    }
    velocity.good = status == "A";
    return velocity;
  }
  return std::nullopt;
}

std::optional<Distance> decode_distance(Bytes frame) {
  for (const FrameId line : {kBottomDistance, kWaterDistance}) {
    const auto text = fields_text(frame, line);
    if (!text) continue;
    const auto v = numbers<5>(*text);
    if (!v) return std::nullopt;
    return Distance{line, {(*v)[0], (*v)[1], (*v)[2]}, (*v)[3], (*v)[4]};
  }
  return std::nullopt;
}

std::optional<Timing> decode_timing(Bytes frame) {
  const auto text = fields_text(frame, kTiming);
  const auto f = text ? split_exactly<6>(*text) : std::nullopt;
  if (!f || (*f)[0].size() != Timing{}.clock.size()) return std::nullopt;
  Timing timing;
  std::copy((*f)[0].begin(), (*f)[0].end(), timing.clock.begin());
  const auto salinity = signed_number((*f)[1]), temperature = signed_number((*f)[2]);
  const auto depth = signed_number((*f)[3]), sound = signed_number((*f)[4]);
  const auto test = integer<std::uint16_t>((*f)[5]);
  if (!salinity || !temperature || !depth || !sound || !test) return std::nullopt;
  timing.salinity_ppt = *salinity;
  timing.temperature_C = *temperature;
  timing.depth_m = *depth;
  timing.speed_of_sound_m_s = *sound;
  timing.self_test = *test;
  return timing;
}

std::vector<std::uint8_t> encode(const Attitude& attitude) {
  std::string line = begin(kAttitude);
  append_padded(line, attitude.pitch_deg, 2, 2, true);
  append_padded(line, attitude.roll_deg, 2, 2, true);
  append_padded(line, attitude.heading_deg, 2, 2, false);
  return ended(line);
}

std::vector<std::uint8_t> encode(const Velocity& velocity) {
  std::string line = begin(velocity.line);
  for (const auto& one : velocity.velocity_m_s) append_velocity(line, one);
  if (is_instrument(velocity.line)) append_velocity(line, velocity.error_velocity_m_s);
  line += velocity.good ? ",A" : ",V";
  return ended(line);
}

std::vector<std::uint8_t> encode(const Distance& distance) {
  std::string line = begin(distance.line);
  for (const double one : distance.east_north_up_m) append_padded(line, one, 8, 2, true);
  append_padded(line, distance.range_m, 4, 2, false);
  append_padded(line, distance.since_good_s, 3, 2, false);
  return ended(line);
}

std::vector<std::uint8_t> encode(const Timing& timing) {
  std::string line = begin(kTiming) + ',' + std::string(timing.clock.begin(), timing.clock.end());
  append_padded(line, timing.salinity_ppt, 2, 1, false);
  append_padded(line, timing.temperature_C, 2, 1, true);
  append_padded(line, timing.depth_m, 4, 1, false);
  append_padded(line, timing.speed_of_sound_m_s, 4, 1, false);
  append_padded(line, timing.self_test, 3, 0, false);
  return ended(line);
}

}  // namespace navcal::protocols::pd6
