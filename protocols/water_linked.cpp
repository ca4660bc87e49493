// SPDX-License-Identifier: Apache-2.0
#include "protocols/water_linked.h"

#include <string>

#include "protocols/checked_line.h"
#include "protocols/crc16.h"
#include "protocols/samples_line.h"
#include "protocols/text_fields.h"

namespace navcal::protocols::water_linked {
namespace {

/// The longest line: wrz with nine covariances of full length.
constexpr std::size_t kMaxLine = 320;
constexpr std::size_t kNameLength = 3;

/// Text between `wr?,` and `*` of a line with this name.
std::optional<std::string_view> body_text(Bytes frame, FrameId line) {
  const std::string_view text(reinterpret_cast<const char*>(frame.data()), frame.size());
  const std::size_t star = text.rfind('*');
  if (!text.starts_with(line.view()) || star == std::string_view::npos || star < kNameLength + 1)
    return std::nullopt;
  if (text[kNameLength] != ',') return std::nullopt;
  return text.substr(kNameLength + 1, star - kNameLength - 1);
}

std::optional<std::array<double, 9>> read_covariance(std::string_view text) {
  std::array<double, 9> covariance{};
  for (std::size_t i = 0; i < covariance.size(); ++i) {
    const std::size_t end = text.find(';');
    if ((end == std::string_view::npos) != (i + 1 == covariance.size())) return std::nullopt;
    const auto value = signed_number(text.substr(0, end));
    if (!value) return std::nullopt;
    covariance[i] = *value;
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  return covariance;
}

void covariance(LineReader& line, std::optional<std::array<double, 9>>& values) {
  values = read_covariance(line.take());
  line.refuse_unless(values.has_value());
}
void covariance(LineWriter& line, const std::optional<std::array<double, 9>>& values) {
  std::string text;
  for (const double one : values.value_or(std::array<double, 9>{})) {
    if (!text.empty()) text += ';';
    append_shortest(text, one);
  }
  line.text(text);
}

/// What a line always has, whatever the member may lack.
void stated(LineReader& line, std::optional<std::int64_t>& value) { line.number(value.emplace()); }
void stated(LineWriter& line, const std::optional<std::int64_t>& value) { line.number(value.value_or(0)); }

constexpr auto kLayOutVelocity = [](auto& line, auto& v) {
  line.number(v.velocity_m_s, Print{3});
  line.letter(v.valid, 'y', 'n');
  line.number(v.altitude_m, Print{2});
  line.number(v.figure_of_merit_m_s, Print{3});
  covariance(line, v.covariance_m2_s2);
  stated(line, v.valid_at_us);
  stated(line, v.transmitted_at_us);
  line.number(v.since_last_ms, Print{2});
  line.number(v.status);
};

constexpr auto kLayOutVelocityOld = [](LineReader& line, Velocity& v) {
  line.number(v.since_last_ms);
  line.number(v.velocity_m_s);
  line.number(v.figure_of_merit_m_s);
  line.number(v.altitude_m);
  line.letter(v.valid, 'y', 'n');
  line.number(v.status);
};

constexpr auto kLayOutTransducer = [](auto& line, auto& t) {
  line.number(t.number);
  line.number(t.velocity_m_s, Print{3});
  line.number(t.distance_m, Print{2});
  line.number(t.signal_dBm, Print{0});
  line.number(t.noise_dBm, Print{0});
};

constexpr auto kLayOutPosition = [](LineReader& line, Position& p) {
  line.number(p.time_s);
  line.number(p.position_m);
  for (double* const value : {&p.std_m, &p.roll_deg, &p.pitch_deg, &p.yaw_deg}) line.number(*value);
  line.number(p.status);
};

/// The content of a line with this name.
template <class Content, class LayOut>
std::optional<Content> decoded(Bytes frame, FrameId name, LayOut lay_out) {
  const auto text = body_text(frame, name);
  return text ? content_of<Content>(LineReader(*text), lay_out) : std::nullopt;
}

/// An object and the end of its line. Brackets are counted, so that a line that was cut costs no other.
Scan scan_object(const std::uint8_t* first, const std::uint8_t* last) {
  const auto available = std::min(static_cast<std::size_t>(last - first), Scanner::kMaxFrameLength);
  std::size_t depth = 0, length = 0;
  bool in_text = false;
  for (; length < available && (length == 0 || depth > 0); ++length) {
    const std::uint8_t byte = first[length];
    if (byte < ' ') return Scan::bad_checksum();
    if (byte == '"') in_text = !in_text;
    if (!in_text && byte == '{') ++depth;
    if (!in_text && byte == '}') --depth;
  }
  const std::size_t inside = length;
  if (depth == 0 && length < available && first[length] == '\r') ++length;
  if (depth == 0 && length < available) {
    const auto object = samples_line::Object::parse(Bytes(first, inside), true);
    if (first[length] != '\n' || !object) return Scan::bad_checksum();
    const auto* const type = object->find("type");
    return Scan::frame(length + 1, type != nullptr ? FrameId(type->value) : kVelocityJson);
  }
  return available == Scanner::kMaxFrameLength
             ? Scan::not_a_frame()
             : Scan::incomplete(std::min(depth + 1, Scanner::kMaxFrameLength - available));
}

/// Members of an object in JSON, of which each must be there and in range.
class JsonNumbers {
 public:
  explicit JsonNumbers(const samples_line::Object& object) : fields(object) {}
  double operator()(std::string_view key, double most = 1e9) {
    const auto number = fields.number(key, {-most, most});
    if (!number) fields.refuse();
    return number.value_or(0);
  }
  samples_line::Fields fields;
};

std::optional<Velocity> decode_json_velocity(const samples_line::Object& object) {
  JsonNumbers number(object);
  Velocity v;
  v.velocity_m_s = {number("vx"), number("vy"), number("vz")};
  v.altitude_m = number("altitude");
  v.figure_of_merit_m_s = number("fom");
  v.since_last_ms = number("time");
  v.status = number.fields.integer("status", UINT32_MAX).value_or(0);
  const auto valid = number.fields.boolean("velocity_valid");
  v.valid = valid.value_or(false);
  if (const auto* const covariance = object.find("covariance")) {
    std::string flat;
    for (const char c : covariance->value) {
      if (c != '[' && c != ']' && c != ' ') flat += c == ',' ? ';' : c;
    }
    v.covariance_m2_s2 = read_covariance(flat);
  }
  constexpr double kMostTime_us = 9e15;
  if (object.find("time_of_validity") != nullptr && object.find("time_of_transmission") != nullptr) {
    v.valid_at_us = static_cast<std::int64_t>(number("time_of_validity", kMostTime_us));
    v.transmitted_at_us = static_cast<std::int64_t>(number("time_of_transmission", kMostTime_us));
  }
  return valid && number.fields.all_good() ? std::optional(v) : std::nullopt;
}

}  // namespace

Scan Scanner::scan(const std::uint8_t* first, const std::uint8_t* last) {
  if (*first == '{') return scan_object(first, last);
  const auto available = std::min(static_cast<std::size_t>(last - first), kMaxLine);
  const auto need = [&](std::size_t missing) {
    return available == kMaxLine ? Scan::not_a_frame() : Scan::incomplete(std::min(missing, kMaxLine - available));
  };
  if (available > 1 && first[1] != 'r') return Scan::not_a_frame();
  if (available < 4) return need(1);
  if (first[3] != ',' && first[3] != '*') return Scan::not_a_frame();
  std::size_t star = 3;
  while (star < available && first[star] != '*') {
    if (first[star] < ' ' || first[star] > '~') return Scan::not_a_frame();
    ++star;
  }
  if (star + 3 >= available) return need(star + 4 - available);
  const unsigned high = detail::kHexValue[first[star + 1]], low = detail::kHexValue[first[star + 2]];
  if (high > 15 || low > 15 || crc8(Bytes(first, star)) != (high << 4 | low)) return Scan::bad_checksum();
  const FrameId id(std::string_view(reinterpret_cast<const char*>(first), kNameLength));
  if (first[star + 3] == '\n') return Scan::frame(star + 4, id);
  if (first[star + 3] != '\r') return Scan::bad_checksum();
  if (star + 4 >= available) return need(1);
  return first[star + 4] == '\n' ? Scan::frame(star + 5, id) : Scan::bad_checksum();
}

std::optional<Velocity> decode_velocity(Bytes frame) {
  if (const auto object = samples_line::Object::parse(frame, true)) return decode_json_velocity(*object);
  if (body_text(frame, kVelocity)) return decoded<Velocity>(frame, kVelocity, kLayOutVelocity);
  return decoded<Velocity>(frame, kVelocityOld, kLayOutVelocityOld);
}
std::vector<std::uint8_t> encode(const Velocity& v) {
  return encode_line(line_of(kVelocity.view(), v, kLayOutVelocity));
}

std::optional<Transducer> decode_transducer(Bytes frame) {
  return decoded<Transducer>(frame, kTransducer, kLayOutTransducer);
}
std::vector<std::uint8_t> encode(const Transducer& t) {
  return encode_line(line_of(kTransducer.view(), t, kLayOutTransducer));
}

std::optional<Position> decode_position(Bytes frame) {
  if (const auto object = samples_line::Object::parse(frame, true)) {
    JsonNumbers number(*object);
    const Position p{number("ts"),
                     {number("x"), number("y"), number("z")},
                     number("std"),
                     number("roll"),
                     number("pitch"),
                     number("yaw"),
                     number.fields.integer("status", UINT32_MAX).value_or(0)};
    return number.fields.all_good() ? std::optional(p) : std::nullopt;
  }
  return decoded<Position>(frame, kPosition, kLayOutPosition);
}

std::vector<std::uint8_t> encode_line(std::string_view body) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  const std::uint8_t crc = crc8({reinterpret_cast<const std::uint8_t*>(body.data()), body.size()});
  std::string line(body);
  line += '*';
  line += kDigits[crc >> 4];
  line += kDigits[crc & 0x0F];
  line += "\r\n";
  return {line.begin(), line.end()};
}

}  // namespace navcal::protocols::water_linked
