// SPDX-License-Identifier: Apache-2.0
#include "protocols/ubx_configuration.h"

#include <array>
#include <cassert>

#include "protocols/wire_fields.h"

namespace navcal::protocols::ubx {
std::optional<Acknowledgement> decode_acknowledgement(Bytes frame) {
  const auto accepted = payload_if(frame, kAckAck, 2), refused = payload_if(frame, kAckNak, 2);
  if (!accepted && !refused) return std::nullopt;
  return Acknowledgement{get_be<MessageCode>(accepted ? accepted->data() : refused->data()), accepted.has_value()};
}

std::vector<std::uint8_t> encode_acknowledgement(const Acknowledgement& acknowledgement) {
  std::array<std::uint8_t, 2> payload{};
  put_be(payload.data(), acknowledgement.code);
  return encode_frame(acknowledgement.accepted ? kAckAck : kAckNak, payload);
}

std::optional<MessageRate> decode_cfg_msg(Bytes frame) {
  const auto payload = payload_if(frame, kCfgMsg, 3);
  if (!payload || payload->size() != 3) return std::nullopt;
  return MessageRate{get_be<MessageCode>(payload->data()), (*payload)[2]};
}

std::vector<std::uint8_t> encode_cfg_msg(const MessageRate& rate) {
  std::array<std::uint8_t, 3> payload{};
  put_be(payload.data(), rate.code);
  payload[2] = rate.epochs;
  return encode_frame(kCfgMsg, payload);
}

std::optional<EpochRate> decode_cfg_rate(Bytes frame) {
  const auto payload = payload_if(frame, kCfgRate, 6);
  if (!payload || payload->size() != 6) return std::nullopt;
  return EpochRate{get_le<std::uint16_t>(payload->data()), get_le<std::uint16_t>(payload->data() + 2)};
}

std::vector<std::uint8_t> encode_cfg_rate(const EpochRate& rate) {
  std::array<std::uint8_t, 6> payload{};  // the last two bytes: reference time 0, which is UTC
  put_le(payload.data(), rate.interval_ms);
  put_le(payload.data() + 2, rate.epochs);
  return encode_frame(kCfgRate, payload);
}

std::optional<ValueSet> decode_cfg_valset(Bytes frame) {
  const auto payload = payload_if(frame, kCfgValset, 4);
  if (!payload) return std::nullopt;
  ValueSet set{(*payload)[1], {}};
  for (Bytes rest = payload->subspan(4); !rest.empty();) {
    if (rest.size() < 4) return std::nullopt;
    const auto key = get_le<std::uint32_t>(rest.data());
    const std::size_t size = value_size(key);
    if (size == 0 || rest.size() < 4 + size) return std::nullopt;
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < size; ++i) value |= std::uint64_t{rest[4 + i]} << 8 * i;
    set.items.push_back({key, value});
    rest = rest.subspan(4 + size);
  }
  return set;
}

std::vector<std::uint8_t> encode_cfg_valset(std::uint8_t layers, std::span<const ConfigurationItem> items) {
  assert(items.size() <= kMaxItems);
  std::vector<std::uint8_t> payload{0, layers, 0, 0};
  for (const auto& [key, value] : items) {
    const std::size_t size = value_size(key);
    assert(size > 0);
    std::array<std::uint8_t, 12> item{};
    put_le(item.data(), key);
    put_le(item.data() + 4, value);
    payload.insert(payload.end(), item.begin(), item.begin() + static_cast<std::ptrdiff_t>(4 + size));
  }
  return encode_frame(kCfgValset, payload);
}

}  // namespace navcal::protocols::ubx
