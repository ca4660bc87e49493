// SPDX-License-Identifier: Apache-2.0
#include "protocols/trax.h"

#include <algorithm>
#include <cassert>
#include <string_view>

#include "protocols/crc16.h"
#include "protocols/decimal.h"
#include "protocols/wire_fields.h"

namespace navcal::protocols::trax {
namespace {

constexpr double kTraxGravity_m_s2 = 9.80665;

/// Component of one float: where it is kept, and the unit of the wire in that of the member.
struct Place {
  std::optional<double>* value = nullptr;
  double unit = 1;
};
Place place_of(Component component, Data& data) {
  const auto number = static_cast<std::size_t>(component);
  switch (component) {
    case Component::heading: return {&data.heading_deg};
    case Component::pitch: return {&data.pitch_deg};
    case Component::roll: return {&data.roll_deg};
    case Component::temperature: return {&data.temperature_C};
    case Component::acceleration_x:
    case Component::acceleration_y:
    case Component::acceleration_z: return {&data.acceleration_m_s2[number - 21], kTraxGravity_m_s2};
    case Component::field_x:
    case Component::field_y:
    case Component::field_z: return {&data.field_uT[number - 27]};
    case Component::rate_x:
    case Component::rate_y:
    case Component::rate_z: return {&data.rate_rad_s[number - 74]};
    default: return {};
  }
}

/// Bytes of the value of a component; 0 for an unknown one.
std::size_t size_of(Component component) {
  Data unused;
  switch (component) {
    case Component::distortion:
    case Component::calibrated:
    case Component::heading_status: return 1;
    case Component::quaternion: return 16;
    default: return place_of(component, unused).value != nullptr ? 4 : 0;
  }
}

void read_component(Component component, const std::uint8_t* p, Data& data) {
  if (const Place place = place_of(component, data); place.value != nullptr) {
    *place.value = double{get_be<float>(p)} * place.unit;
  } else if (component == Component::quaternion) {
    data.quaternion.emplace();
    for (std::size_t i = 0; i < 4; ++i) (*data.quaternion)[i] = double{get_be<float>(p + 4 * i)};
  } else if (component == Component::distortion) {
    data.distorted = *p != 0;
  } else if (component == Component::calibrated) {
    data.calibrated = *p != 0;
  } else {
    data.heading_status = *p;
  }
}

/// Payload of a frame with this number, of at least this size.
std::optional<Bytes> payload_if(Bytes frame, FrameNumber number, std::size_t least) {
  if (frame.size() < kOverhead + least || frame[2] != static_cast<std::uint8_t>(number)) return std::nullopt;
  return frame.subspan(3, frame.size() - kOverhead);
}

std::vector<std::uint8_t> encode_u32(FrameNumber number, std::uint32_t value) {
  std::array<std::uint8_t, 4> payload{};
  put_be(payload.data(), value);
  return encode_frame(number, payload);
}
std::optional<std::uint32_t> decode_u32(Bytes frame, FrameNumber number) {
  const auto payload = payload_if(frame, number, 4);
  if (!payload) return std::nullopt;
  return get_be<std::uint32_t>(payload->data());
}

constexpr Component kFloats[] = {Component::heading,        Component::pitch,          Component::roll,
                                 Component::temperature,    Component::acceleration_x, Component::acceleration_y,
                                 Component::acceleration_z, Component::field_x,        Component::field_y,
                                 Component::field_z,        Component::rate_x,         Component::rate_y,
                                 Component::rate_z};

}  // namespace

FrameId id_of(std::uint8_t number) {
  // Names of the manual, by number from 1 on.
  static constexpr auto kNames = [] {
    std::string_view text =
        "GetModInfo ModInfoResp SetDataComponents GetData DataResp SetConfig GetConfig ConfigResp Save "
        "StartCal StopCal SetParam GetParam ParamResp PowerDown SaveDone UserCalSampCount UserCalScore "
        "SetConfigDone SetParamDone StartContinuous StopContinuous PowerUp SetAcqParams GetAcqParams "
        "AcqParamsDone AcqParamsResp PowerDownDone FactoryUserCal FacUserCalDone TakeUserCalSample";
    std::array<std::string_view, 31> names;
    for (std::string_view& name : names) name = take_word(text);
    return names;
  }();
  if (number > 0 && number <= kNames.size()) return FrameId(kNames[number - 1]);
  std::string text;
  append_hex(text, number, 2);
  return FrameId(text);
}

Scan Scanner::scan(const std::uint8_t* first, const std::uint8_t* last) {
  const auto available = static_cast<std::size_t>(last - first);
  if (available < 2) return Scan::incomplete(kOverhead - available);
  const std::size_t length = get_be<std::uint16_t>(first);
  if (length < kOverhead || length > kMaxFrameLength) return Scan::not_a_frame();
  if (available < length) return Scan::incomplete(length - available);
  if (crc16_xmodem(Bytes(first, length - 2)) != get_be<std::uint16_t>(first + length - 2))
    return Scan::bad_checksum();
  return Scan::frame(length, id_of(first[2]));
}

std::optional<Data> decode_data(Bytes frame) {
  const auto payload = payload_if(frame, FrameNumber::data, 1);
  if (!payload) return std::nullopt;
  Data data;
  Bytes rest = payload->subspan(1);
  for (std::size_t left = (*payload)[0]; left > 0; --left) {
    if (rest.empty()) return std::nullopt;
    const auto component = static_cast<Component>(rest[0]);
    const std::size_t size = size_of(component);
    if (size == 0) {
      data.unread = left;
      break;
    }
    if (rest.size() < 1 + size) return std::nullopt;
    read_component(component, &rest[1], data);
    rest = rest.subspan(1 + size);
  }
  return data;
}

std::vector<std::uint8_t> encode_data(const Data& data) {
  std::vector<std::uint8_t> payload(1);
  Data copy = data;
  const auto begin = [&](Component component) {
    ++payload[0];
    payload.push_back(static_cast<std::uint8_t>(component));
  };
  for (const Component component : kFloats) {
    const Place place = place_of(component, copy);
    if (!*place.value) continue;
    begin(component);
    append_be(payload, static_cast<float>(**place.value / place.unit));
  }
  if (data.quaternion) {
    begin(Component::quaternion);
    for (const double one : *data.quaternion) append_be(payload, static_cast<float>(one));
  }
  const auto append_byte = [&](Component component, std::uint8_t value) {
    begin(component);
    payload.push_back(value);
  };
  if (data.distorted) append_byte(Component::distortion, *data.distorted ? 1 : 0);
  if (data.calibrated) append_byte(Component::calibrated, *data.calibrated ? 1 : 0);
  if (data.heading_status) append_byte(Component::heading_status, *data.heading_status);
  return encode_frame(FrameNumber::data, payload);
}

std::optional<std::uint32_t> decode_sample_count(Bytes frame) {
  return decode_u32(frame, FrameNumber::calibration_sample_count);
}
std::vector<std::uint8_t> encode_sample_count(std::uint32_t count) {
  return encode_u32(FrameNumber::calibration_sample_count, count);
}

std::optional<Score> decode_score(Bytes frame) {
  const auto payload = payload_if(frame, FrameNumber::calibration_score, 24);
  if (!payload) return std::nullopt;
  const auto value = [&](std::size_t i) { return double{get_be<float>(&(*payload)[4 * i])}; };
  return Score{value(0), value(1), value(2), value(3), value(4), value(5)};
}
std::vector<std::uint8_t> encode_score(const Score& score) {
  std::vector<std::uint8_t> payload;
  for (const double one : {score.magnetometer, score.reserved, score.accelerometer, score.distribution_error,
                           score.tilt_error, score.tilt_range_deg}) {
    append_be(payload, static_cast<float>(one));
  }
  return encode_frame(FrameNumber::calibration_score, payload);
}

std::vector<std::uint8_t> encode_frame(FrameNumber number, Bytes payload) {
  const std::size_t length = kOverhead + payload.size();
  assert(length <= Scanner::kMaxFrameLength);
  std::vector<std::uint8_t> frame(length);
  put_be(&frame[0], static_cast<std::uint16_t>(length));
  frame[2] = static_cast<std::uint8_t>(number);
  std::copy(payload.begin(), payload.end(), frame.begin() + 3);
  put_be(&frame[length - 2], crc16_xmodem(Bytes(frame).first(length - 2)));
  return frame;
}

std::vector<std::uint8_t> encode_components(std::span<const Component> components) {
  std::vector<std::uint8_t> payload{static_cast<std::uint8_t>(components.size())};
  for (const Component component : components) payload.push_back(static_cast<std::uint8_t>(component));
  return encode_frame(FrameNumber::set_data_components, payload);
}

std::vector<std::uint8_t> encode_setting(Setting setting, double value) {
  std::vector<std::uint8_t> payload{static_cast<std::uint8_t>(setting)};
  if (setting == Setting::declination_deg) {
    append_be(payload, static_cast<float>(value));
  } else if (setting == Setting::calibration_points) {
    payload.resize(5);
    put_be(&payload[1], saturated<std::uint32_t>(value));
  } else {
    payload.push_back(saturated<std::uint8_t>(value));
  }
  return encode_frame(FrameNumber::set_config, payload);
}

std::vector<std::uint8_t> encode_acquisition(const Acquisition& acquisition) {
  std::vector<std::uint8_t> payload{acquisition.polled ? std::uint8_t{1} : std::uint8_t{0}, 0};  // no flush
  append_be(payload, 0.0F);                                                                      // reserved
  append_be(payload, static_cast<float>(acquisition.interval_s));
  return encode_frame(FrameNumber::set_acquisition, payload);
}
std::optional<Acquisition> decode_acquisition(Bytes frame) {
  const auto payload = payload_if(frame, FrameNumber::set_acquisition, 10);
  if (!payload) return std::nullopt;
  return Acquisition{(*payload)[0] != 0, double{get_be<float>(&(*payload)[6])}};
}

std::optional<bool> decode_save_done(Bytes frame) {
  const auto payload = payload_if(frame, FrameNumber::save_done, 2);
  if (!payload) return std::nullopt;
  return get_be<std::uint16_t>(payload->data()) == 0;
}

std::vector<std::uint8_t> encode_start_calibration(Calibration calibration) {
  return encode_u32(FrameNumber::start_calibration, static_cast<std::uint32_t>(calibration));
}

}  // namespace navcal::protocols::trax
