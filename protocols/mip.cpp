// SPDX-License-Identifier: Apache-2.0
#include "protocols/mip.h"

#include <cassert>
#include <string_view>

#include "protocols/decimal.h"
#include "protocols/fletcher.h"
#include "protocols/mip_commands.h"
#include "protocols/wire_fields.h"

namespace navcal::protocols::mip {

namespace {

constexpr double kStandardGravity_m_s2 = 9.80665, kGauss_uT = 100, kMillibar_Pa = 100;

/// Three floats, in the filter set with a validity flag (u16) behind them.
struct VectorField {
  std::uint8_t set, descriptor;
  std::optional<Triple> Packet::*member;
  double unit;  ///< of the wire, in the unit of the member
};
constexpr VectorField kVectorFields[] = {
    {kSensorSet, 0x04, &Packet::acceleration_m_s2, kStandardGravity_m_s2},
    {kSensorSet, 0x05, &Packet::rate_rad_s, 1},
    {kSensorSet, 0x06, &Packet::field_uT, kGauss_uT},
    {kSensorSet, 0x07, &Packet::delta_theta_rad, 1},
    {kSensorSet, 0x08, &Packet::delta_velocity_m_s, kStandardGravity_m_s2},
    {kSensorSet, 0x0C, &Packet::euler_rad, 1},
    {kFilterSet, 0x02, &Packet::filter_velocity_ned_m_s, 1},
    {kFilterSet, 0x05, &Packet::filter_euler_rad, 1},
    {kFilterSet, 0x06, &Packet::filter_gyro_bias_rad_s, 1},
    {kFilterSet, 0x0A, &Packet::filter_euler_std_rad, 1},
    {kFilterSet, 0x0E, &Packet::filter_rate_rad_s, 1},
};

constexpr std::uint8_t kWriteSetting = 1;
constexpr std::uint8_t kSensorSelector = 1, kFilterSelector = 3;
constexpr std::uint8_t kGpsTimeField = 0xD3, kDeltaTimeField = 0xD4, kReferenceField = 0xD5,
                       kReferenceDelta = 0xD6;
constexpr std::uint8_t kReplyField = 0xF1, kPressureField = 0x17, kPositionField = 0x01, kStatusField = 0x10;

constexpr std::uint8_t kSensorRateReply = 0x83, kFilterRateReply = 0x8A, kRateReply = 0x8E;

bool is_data_set(std::uint8_t set) { return set >= 0x80; }

bool is_gps_time(std::uint8_t set, std::uint8_t descriptor) {
  return (is_data_set(set) && descriptor == kGpsTimeField) || (set == kSensorSet && descriptor == 0x12) ||
         (set == kFilterSet && descriptor == 0x11);
}

/// Outcome of reading one field.
enum class Reading { taken, unknown, invalid };

Reading read_vector(const VectorField& field, Bytes data, Packet& packet) {
  const bool flagged = field.set == kFilterSet;
  if (data.size() < (flagged ? 14U : 12U)) return Reading::invalid;
  if (flagged && (get_be<std::uint16_t>(&data[12]) & 1U) == 0) return Reading::invalid;
  Triple value;
  for (std::size_t i = 0; i < 3; ++i) value[i] = double{get_be<float>(&data[4 * i])} * field.unit;
  packet.*field.member = value;
  return Reading::taken;
}

/// The device's clocks, which any data set may carry.
Reading read_shared(std::uint8_t descriptor, Bytes data, Packet& packet) {
  if (data.size() < 8) return Reading::invalid;
  if (descriptor == kDeltaTimeField) {
    packet.delta_time_s = get_be<double>(data.data());
  } else {
    auto& member = descriptor == kReferenceField ? packet.reference_time_ns : packet.reference_delta_ns;
    member = get_be<std::uint64_t>(data.data());
  }
  return Reading::taken;
}

Reading read_gps_time(Bytes data, Packet& packet) {
  if (data.size() < 12) return Reading::invalid;
  const auto valid = get_be<std::uint16_t>(&data[10]);
  packet.gps_time = {get_be<double>(&data[0]), get_be<std::uint16_t>(&data[8]), (valid & 1U) != 0,
                     (valid & 2U) != 0};
  return Reading::taken;
}

Reading read_position(Bytes data, Packet& packet) {
  if (data.size() < 26 || (get_be<std::uint16_t>(&data[24]) & 1U) == 0) return Reading::invalid;
  packet.filter_position = {get_be<double>(&data[0]), get_be<double>(&data[8]), get_be<double>(&data[16])};
  return Reading::taken;
}

/// Base rate of sensor data, of filter data, or of the set that the answer names.
Reading read_base_rate(std::uint8_t descriptor, Bytes data, Packet& packet) {
  if (descriptor == kRateReply) {
    if (data.size() < 3) return Reading::invalid;
    packet.base_rate = {data[0], get_be<std::uint16_t>(&data[1])};
  } else {
    if (data.size() < 2) return Reading::invalid;
    packet.base_rate = {descriptor == kSensorRateReply ? kSensorSet : kFilterSet,
                        get_be<std::uint16_t>(data.data())};
  }
  return Reading::taken;
}

Reading read_field(std::uint8_t descriptor, Bytes data, Packet& packet) {
  const std::uint8_t set = packet.set;
  for (const VectorField& field : kVectorFields) {
    if (field.set == set && field.descriptor == descriptor) return read_vector(field, data, packet);
  }
  if (is_gps_time(set, descriptor)) return read_gps_time(data, packet);
  if (is_data_set(set) && descriptor >= kDeltaTimeField && descriptor <= kReferenceDelta) {
    return read_shared(descriptor, data, packet);
  }
  if (set == kSensorSet && descriptor == kPressureField) {
    if (data.size() < 4) return Reading::invalid;
    packet.pressure_Pa = double{get_be<float>(data.data())} * kMillibar_Pa;
    return Reading::taken;
  }
  if (set == kFilterSet && descriptor == kPositionField) return read_position(data, packet);
  if (set == kFilterSet && descriptor == kStatusField) {
    if (data.size() < 6) return Reading::invalid;
    packet.filter_state = get_be<std::uint16_t>(data.data());
    return Reading::taken;
  }
  if (!is_data_set(set) && descriptor == kReplyField) {
    if (data.size() < 2) return Reading::invalid;
    packet.reply = Reply{data[0], data[1]};
    return Reading::taken;
  }
  if (set == k3dmSet &&
      (descriptor == kSensorRateReply || descriptor == kFilterRateReply || descriptor == kRateReply)) {
    return read_base_rate(descriptor, data, packet);
  }
  return Reading::unknown;
}

template <WireNumber... T>
Field field_of(std::uint8_t descriptor, T... values) {
  Field field{descriptor, {}};
  (append_be(field.data, values), ...);
  return field;
}

/// A command whose arguments end with a list of fields and their rates.
std::vector<std::uint8_t> encode_format(Field field, const std::vector<FieldRate>& rates) {
  field.data.push_back(static_cast<std::uint8_t>(rates.size()));
  for (const FieldRate& rate : rates) {
    field.data.push_back(rate.descriptor);
    append_be(field.data, rate.decimation);
  }
  return encode_fields(k3dmSet, {field});
}

}  // namespace

FrameId id_of(std::uint8_t set) {
  std::string text;
  append_hex(text, set, 2);
  return FrameId(text);
}

Scan Scanner::scan(const std::uint8_t* first, const std::uint8_t* last) {
  const auto available = static_cast<std::size_t>(last - first);
  if (available > 1 && first[1] != 0x65) return Scan::not_a_frame();
  if (available < 4) return Scan::incomplete(kOverhead - available);
  const std::size_t length = kOverhead + first[3];
  if (available < length) return Scan::incomplete(length - available);
  if (fletcher_of(Bytes(first, length - 2)) != Fletcher{first[length - 2], first[length - 1]}) {
    return Scan::bad_checksum();
  }
  return Scan::frame(length, id_of(first[2]));
}

Packet decode(Bytes frame) {
  Packet packet;
  if (frame.size() < kOverhead) return packet;
  packet.set = frame[2];
  for (Bytes rest = frame.subspan(4, frame.size() - kOverhead); !rest.empty();) {
    const std::size_t length = rest[0];
    if (length < 2 || length > rest.size()) {
      ++packet.invalid_fields;
      break;
    }
    const Reading reading = read_field(rest[1], rest.subspan(2, length - 2), packet);
    if (reading == Reading::unknown) ++packet.unknown_fields;
    if (reading == Reading::invalid) ++packet.invalid_fields;
    rest = rest.subspan(length);
  }
  return packet;
}

std::vector<std::uint8_t> encode(const Packet& packet) {
  constexpr std::uint16_t kValid = 1;
  std::vector<Field> fields;
  if (packet.reference_time_ns) fields.push_back(field_of(kReferenceField, *packet.reference_time_ns));
  if (packet.reference_delta_ns) fields.push_back(field_of(kReferenceDelta, *packet.reference_delta_ns));
  if (packet.delta_time_s) fields.push_back(field_of(kDeltaTimeField, *packet.delta_time_s));
  if (const auto& time = packet.gps_time) {
    const unsigned valid = (time->time_of_week_valid ? 1U : 0U) | (time->week_valid ? 2U : 0U);
    fields.push_back(field_of(kGpsTimeField, time->time_of_week_s, time->week, static_cast<std::uint16_t>(valid)));
  }
  if (packet.reply) fields.push_back(field_of(kReplyField, packet.reply->command, packet.reply->error));
  for (const VectorField& format : kVectorFields) {
    const auto& value = packet.*format.member;
    if (format.set != packet.set || !value) continue;
    Field field{format.descriptor, {}};
    for (const double one : *value) append_be(field.data, static_cast<float>(one / format.unit));
    if (format.set == kFilterSet) append_be(field.data, kValid);
    fields.push_back(field);
  }
  if (packet.set == kSensorSet && packet.pressure_Pa) {
    fields.push_back(field_of(kPressureField, static_cast<float>(*packet.pressure_Pa / kMillibar_Pa)));
  }
  if (packet.set == kFilterSet && packet.filter_position) {
    const Triple& p = *packet.filter_position;
    fields.push_back(field_of(kPositionField, p[0], p[1], p[2], kValid));
  }
  if (packet.set == kFilterSet && packet.filter_state) {
    fields.push_back(field_of(kStatusField, *packet.filter_state, std::uint16_t{1}, std::uint16_t{0}));
  }
  return encode_fields(packet.set, fields);
}

std::vector<std::uint8_t> encode_fields(std::uint8_t set, const std::vector<Field>& fields) {
  std::vector<std::uint8_t> frame{0x75, 0x65, set, 0};
  for (const Field& field : fields) {
    frame.push_back(static_cast<std::uint8_t>(field.data.size() + 2));
    frame.push_back(field.descriptor);
    frame.insert(frame.end(), field.data.begin(), field.data.end());
  }
  assert(frame.size() <= 4 + 255);
  frame[3] = static_cast<std::uint8_t>(frame.size() - 4);
  const Fletcher sum = fletcher_of(frame);
  frame.push_back(sum.first);
  frame.push_back(sum.second);
  return frame;
}

std::vector<std::uint8_t> encode_command(BaseCommand command) {
  return encode_fields(kBaseSet, {{static_cast<std::uint8_t>(command), {}}});
}

std::vector<std::uint8_t> encode_message_format(std::uint8_t set, const std::vector<FieldRate>& rates) {
  return encode_format({command_3dm::kFormat, {kWriteSetting, set}}, rates);
}

std::vector<std::uint8_t> encode_base_rate_request(std::uint8_t set, bool by_set) {
  if (!by_set) return encode_fields(k3dmSet, {{command_3dm::kBaseRate, {set}}});
  return encode_fields(k3dmSet,
                       {{set == kFilterSet ? command_3dm::kFilterBaseRate : command_3dm::kSensorBaseRate, {}}});
}

std::vector<std::uint8_t> encode_format_by_set(std::uint8_t set, const std::vector<FieldRate>& rates) {
  return encode_format(
      {set == kFilterSet ? command_3dm::kFilterFormat : command_3dm::kSensorFormat, {kWriteSetting}}, rates);
}

std::vector<std::uint8_t> encode_data_stream(std::uint8_t set, bool on, bool by_set) {
  const std::uint8_t selector = !by_set ? set : set == kFilterSet ? kFilterSelector : kSensorSelector;
  return encode_fields(
      k3dmSet, {{command_3dm::kDataStream, {kWriteSetting, selector, on ? std::uint8_t{1} : std::uint8_t{0}}}});
}

std::vector<std::uint8_t> encode_reply(std::uint8_t set, const Reply& reply) {
  return encode_fields(set, {{kReplyField, {reply.command, reply.error}}});
}

std::vector<std::uint8_t> encode_base_rate(const Reply& reply, const BaseRate& rate) {
  Field field;
  switch (reply.command) {
    case command_3dm::kSensorBaseRate: field.descriptor = kSensorRateReply; break;
    case command_3dm::kFilterBaseRate: field.descriptor = kFilterRateReply; break;
    default: field = {kRateReply, {rate.set}}; break;
  }
  append_be(field.data, rate.rate_Hz);
  return encode_fields(k3dmSet, {{kReplyField, {reply.command, reply.error}}, field});
}

std::vector<FieldBytes> fields_of(Bytes frame) {
  std::vector<FieldBytes> fields;
  if (frame.size() < kOverhead) return fields;
  for (Bytes rest = frame.subspan(4, frame.size() - kOverhead); !rest.empty();) {
    const std::size_t length = rest[0];
    if (length < 2 || length > rest.size()) break;
    fields.push_back({rest[1], rest.subspan(2, length - 2)});
    rest = rest.subspan(length);
  }
  return fields;
}

std::vector<FieldRate> decode_format(Bytes list) {
  std::vector<FieldRate> rates;
  if (list.empty() || list.size() != 1 + std::size_t{3} * list[0]) return rates;
  for (Bytes rest = list.subspan(1); !rest.empty(); rest = rest.subspan(3)) {
    rates.push_back({rest[0], get_be<std::uint16_t>(&rest[1])});
  }
  return rates;
}

}  // namespace navcal::protocols::mip
