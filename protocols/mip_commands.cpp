// SPDX-License-Identifier: Apache-2.0
#include "protocols/mip_commands.h"

#include "protocols/wire_fields.h"

namespace navcal::protocols::mip {
namespace {

constexpr std::uint8_t kWriteSetting = 1;
constexpr std::uint8_t kAnswer = 0xF1;
constexpr std::uint8_t kSensorRateAnswer = 0x83, kFilterRateAnswer = 0x8A, kRateAnswer = 0x8E;
constexpr std::uint8_t kSensorSelector = 1, kFilterSelector = 3;

}  // namespace

std::vector<std::uint8_t> encode_base_rate_request(std::uint8_t set, bool by_set) {
  if (!by_set) return encode_fields(k3dmSet, {{command_3dm::kBaseRate, {set}}});
  return encode_fields(k3dmSet,
                       {{set == kFilterSet ? command_3dm::kFilterBaseRate : command_3dm::kSensorBaseRate, {}}});
}

std::vector<std::uint8_t> encode_format_by_set(std::uint8_t set, const std::vector<FieldRate>& rates) {
  Field field{set == kFilterSet ? command_3dm::kFilterFormat : command_3dm::kSensorFormat,
              {kWriteSetting, static_cast<std::uint8_t>(rates.size())}};
  for (const FieldRate& rate : rates) {
    field.data.push_back(rate.descriptor);
    append_be(field.data, rate.decimation);
  }
  return encode_fields(k3dmSet, {field});
}

std::vector<std::uint8_t> encode_data_stream(std::uint8_t set, bool on, bool by_set) {
  const std::uint8_t selector = !by_set ? set : set == kFilterSet ? kFilterSelector : kSensorSelector;
  return encode_fields(
      k3dmSet, {{command_3dm::kDataStream, {kWriteSetting, selector, on ? std::uint8_t{1} : std::uint8_t{0}}}});
}

std::vector<std::uint8_t> encode_reply(std::uint8_t set, const Reply& reply) {
  return encode_fields(set, {{kAnswer, {reply.command, reply.error}}});
}

std::vector<std::uint8_t> encode_base_rate(const Reply& reply, const BaseRate& rate) {
  Field field;
  switch (reply.command) {
    case command_3dm::kSensorBaseRate: field.descriptor = kSensorRateAnswer; break;
    case command_3dm::kFilterBaseRate: field.descriptor = kFilterRateAnswer; break;
    default: field = {kRateAnswer, {rate.set}}; break;
  }
  append_be(field.data, rate.rate_Hz);
  return encode_fields(k3dmSet, {{kAnswer, {reply.command, reply.error}}, field});
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
