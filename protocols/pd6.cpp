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

void velocity(LineReader& line, std::optional<double>& value_m_s) {
  double value_mm_s = 0;
  line.number(value_mm_s);
  if (std::abs(value_mm_s) < kNone_mm_s) value_m_s = value_mm_s * kMillimetre_m;
}
void velocity(LineWriter& line, const std::optional<double>& value_m_s) {
  if (!value_m_s) return line.text("-32768");
  line.number(*value_m_s / kMillimetre_m, Print{0, 5, true});
}

constexpr auto kLayOutAttitude = [](auto& line, auto& attitude) {
  line.number(attitude.pitch_deg, Print{2, 2, true});
  line.number(attitude.roll_deg, Print{2, 2, true});
  line.number(attitude.heading_deg, Print{2, 2});
};

void status(LineReader& line, bool& good) { good = line.take() == "A"; }
void status(LineWriter& line, bool good) { line.letter(good, 'A', 'V'); }

constexpr auto kLayOutVelocity = [](auto& line, auto& of) {
  for (auto& one : of.velocity_m_s) velocity(line, one);
  if (of.line == kBottomInstrument || of.line == kWaterInstrument) velocity(line, of.error_velocity_m_s);
  status(line, of.good);
};

constexpr auto kLayOutDistance = [](auto& line, auto& distance) {
  line.number(distance.east_north_up_m, Print{2, 8, true});
  line.number(distance.range_m, Print{2, 4});
  line.number(distance.since_good_s, Print{2, 3});
};

void clock(LineReader& line, std::array<char, 14>& digits) {
  const std::string_view text = line.take();
  line.refuse_unless(text.size() == digits.size());
  std::copy_n(text.begin(), std::min(text.size(), digits.size()), digits.begin());
}
void clock(LineWriter& line, const std::array<char, 14>& digits) { line.text({digits.data(), digits.size()}); }

constexpr auto kLayOutTiming = [](auto& line, auto& timing) {
  clock(line, timing.clock);
  line.number(timing.salinity_ppt, Print{1, 2});
  line.number(timing.temperature_C, Print{1, 2, true});
  line.number(timing.depth_m, Print{1, 4});
  line.number(timing.speed_of_sound_m_s, Print{1, 4});
  line.number(timing.self_test, Print{0, 3});
};

/// The message of a line, whose name is one of `lines`.
template <class Message, class LayOut>
std::optional<Message> decoded(Bytes frame, std::initializer_list<FrameId> lines, LayOut lay_out) {
  std::string_view text(reinterpret_cast<const char*>(frame.data()), frame.size());
  if (text.size() < kNameEnd + 1) return std::nullopt;
  const FrameId name(text.substr(1, 2));
  if (std::find(lines.begin(), lines.end(), name) == lines.end()) return std::nullopt;
  while (text.ends_with('\n') || text.ends_with('\r')) text.remove_suffix(1);
  Message message;
  if constexpr (requires { message.line; }) message.line = name;
  return content_of(LineReader(text.substr(std::min(text.size(), kNameEnd + 1))), lay_out, message);
}

template <class Message, class LayOut>
std::vector<std::uint8_t> encoded(FrameId name, const Message& message, LayOut lay_out) {
  const std::string text = line_of(':' + std::string(name.view()), message, lay_out) + "\r\n";
  return {text.begin(), text.end()};
}

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
  return decoded<Attitude>(frame, {kAttitude}, kLayOutAttitude);
}
std::optional<Velocity> decode_velocity(Bytes frame) {
  return decoded<Velocity>(
      frame, {kBottomInstrument, kBottomShip, kBottomEarth, kWaterInstrument, kWaterShip, kWaterEarth},
      kLayOutVelocity);
}
std::optional<Distance> decode_distance(Bytes frame) {
  return decoded<Distance>(frame, {kBottomDistance, kWaterDistance}, kLayOutDistance);
}
std::optional<Timing> decode_timing(Bytes frame) { return decoded<Timing>(frame, {kTiming}, kLayOutTiming); }

std::vector<std::uint8_t> encode(const Attitude& attitude) {
  return encoded(kAttitude, attitude, kLayOutAttitude);
}
std::vector<std::uint8_t> encode(const Velocity& of) { return encoded(of.line, of, kLayOutVelocity); }
std::vector<std::uint8_t> encode(const Distance& distance) {
  return encoded(distance.line, distance, kLayOutDistance);
}
std::vector<std::uint8_t> encode(const Timing& timing) { return encoded(kTiming, timing, kLayOutTiming); }

}  // namespace navcal::protocols::pd6
