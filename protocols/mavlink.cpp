// SPDX-License-Identifier: Apache-2.0
#include "protocols/mavlink.h"

#include "protocols/crc16.h"
#include "protocols/decimal.h"

namespace navcal::protocols::mavlink {

/// Rows of mavlink_messages.txt in the order of the numbers: name, number, CRC_EXTRA and length of a message.
const char* mavlink_message_rows();

namespace {

const std::vector<MessageInfo>& messages() {
  static const std::vector<MessageInfo> kMessages = [] {
    std::vector<MessageInfo> all;
    std::string_view text = mavlink_message_rows();
    for (MessageInfo info; !(info.name = take_word(text)).empty(); all.push_back(info)) {
      info.id = integer<std::uint32_t>(take_word(text)).value();
      info.crc_extra = integer<std::uint8_t>(take_word(text)).value();
      info.length = integer<std::uint8_t>(take_word(text)).value();
    }
    return all;
  }();
  return kMessages;
}

/// The sum of a frame with `info`, of which `frame` are all bytes before its own sum, for a payload of so many
/// bytes; those that `frame` lacks are zero.
std::uint16_t sum_of(Bytes frame, std::size_t head, std::size_t length, const MessageInfo& info) {
  std::array<std::uint8_t, Scanner::kMaxFrameLength> summed{};
  std::copy(frame.begin() + 1, frame.end(), summed.begin());
  summed[0] = static_cast<std::uint8_t>(length);
  summed[head - 1 + length] = info.crc_extra;
  return crc16_mcrf4xx(Bytes(summed).first(head + length));
}

}  // namespace

const MessageInfo* message_of(std::uint32_t id) {
  const auto found = std::ranges::lower_bound(messages(), id, {}, &MessageInfo::id);
  return found == messages().end() || found->id != id ? nullptr : &*found;
}

std::string Message::name() const {
  return info != nullptr ? std::string(info->name) : "MSG " + std::to_string(id);
}

std::string Payload::text(std::size_t offset, std::size_t length) const {
  const std::string text(bytes_.begin() + static_cast<std::ptrdiff_t>(offset),
                         bytes_.begin() + static_cast<std::ptrdiff_t>(offset + length));
  return text.substr(0, text.find('\0'));
}

Found find_message(Bytes bytes) {
  using Verdict = Found::Verdict;
  constexpr std::size_t kHead1 = 6, kHead2 = 10, kChecksum = 2, kSignature = 13;
  if (bytes.empty()) return {Verdict::incomplete, {}, kHead1 + kChecksum};
  const bool is_second = bytes[0] == 0xFD;
  if (!is_second && bytes[0] != 0xFE) return {};
  if (is_second && bytes.size() > 2 && (bytes[2] & ~1U) != 0) return {};
  const std::size_t head = is_second ? kHead2 : kHead1;
  if (bytes.size() < head) return {Verdict::incomplete, {}, head + kChecksum - bytes.size()};
  Message message;
  const std::size_t payload = bytes[1];
  message.is_signed = is_second && (bytes[2] & 1U) != 0;
  message.length = head + payload + kChecksum + (message.is_signed ? kSignature : 0);
  message.system = bytes[is_second ? 5 : 3];
  message.component = bytes[is_second ? 6 : 4];
  message.id = is_second ? bytes[7] | std::uint32_t{bytes[8]} << 8 | std::uint32_t{bytes[9]} << 16 : bytes[5];
  message.info = message_of(message.id);
  if (bytes.size() < message.length) return {Verdict::incomplete, message, message.length - bytes.size()};
  message.payload = bytes.subspan(head, payload);
  if (message.info == nullptr) return {Verdict::frame, message, 0};
  const auto sent = get_le<std::uint16_t>(bytes.data() + head + payload);
  const Bytes summed = bytes.first(head + payload);
  if (sum_of(summed, head, payload, *message.info) == sent) return {Verdict::frame, message, 0};
  message.is_untrimmed = is_second && payload < message.info->length &&
                         sum_of(summed, head, message.info->length, *message.info) == sent;
  return {message.is_untrimmed ? Verdict::frame : Verdict::bad_checksum, message, 0};
}

Scan Scanner::scan(const std::uint8_t* first, const std::uint8_t* last) {
  const auto [verdict, message, missing] = find_message({first, last});
  if (verdict != Scan::Kind::frame) return {verdict, missing, {}};
  if (message.info != nullptr) return Scan::frame(message.length, FrameId(message.info->name));
  return *first == 0xFD ? Scan::frame(message.length, FrameId(message.name())) : Scan::not_a_frame();
}

std::vector<std::uint8_t> encode(std::uint32_t id, Sender sender, Bytes payload) {
  while (payload.size() > 1 && payload.back() == 0) payload = payload.first(payload.size() - 1);
  const auto length = static_cast<std::uint8_t>(payload.size());
  std::vector<std::uint8_t> frame{0xFD, length, 0, 0, sender.sequence, sender.system, sender.component};
  append_le(frame, static_cast<std::uint16_t>(id));
  frame.push_back(static_cast<std::uint8_t>(id >> 16));
  frame.insert(frame.end(), payload.begin(), payload.end());
  append_checksum(frame, id);
  return frame;
}

void append_checksum(std::vector<std::uint8_t>& frame, std::uint32_t id) {
  append_le(frame, sum_of(frame, frame.size() - frame[1], frame[1], *message_of(id)));
}

std::vector<std::uint8_t> encode_heartbeat(Sender sender, std::uint8_t type) {
  constexpr std::uint8_t kActive = 4, kVersion = 3;
  return encode(0, sender, packed_le(0U, type, kNoAutopilot, std::uint8_t{0}, kActive, kVersion));
}

Parameter parameter_of(const Message& parameter_value, bool is_bytewise) {
  const Payload payload(parameter_value.payload);
  Parameter parameter{payload.text(8, 16), payload.at<std::uint8_t>(24), payload.at<float>(0)};
  if (is_bytewise && parameter.type == Parameter::kInt32) parameter.value = payload.at<std::int32_t>(0);
  return parameter;
}

std::vector<std::uint8_t> encode_setting(Sender sender, std::uint8_t vehicle, const Parameter& parameter,
                                         bool is_bytewise) {
  std::vector<std::uint8_t> payload;
  if (is_bytewise && parameter.type == Parameter::kInt32)
    append_le(payload, saturated<std::int32_t>(parameter.value));
  else
    append_le(payload, static_cast<float>(parameter.value));
  payload.insert(payload.end(), {vehicle, kAutopilot});
  payload.insert(payload.end(), parameter.name.begin(), parameter.name.end());
  payload.resize(22);
  payload.push_back(parameter.type);
  return encode(23, sender, payload);
}

std::vector<std::uint8_t> encode_reading(Sender sender, std::uint8_t vehicle, std::string_view name) {
  std::vector<std::uint8_t> payload{0xFF, 0xFF, vehicle, kAutopilot};  // -1: by its name
  payload.insert(payload.end(), name.begin(), name.end());
  payload.resize(20);
  return encode(20, sender, payload);
}

}  // namespace navcal::protocols::mavlink
