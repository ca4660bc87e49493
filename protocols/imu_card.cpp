// SPDX-License-Identifier: Apache-2.0
#include "protocols/imu_card.h"

#include "protocols/crc16.h"
#include "protocols/wire_fields.h"

namespace navcal::protocols::imu_card {
namespace {

// Offsets of ICD section 3.
constexpr std::size_t kSequence = 2;
constexpr std::size_t kStatus = 3;
constexpr std::size_t kChannels = 4;
constexpr std::size_t kCrc = 20;

std::uint16_t crc_of(const std::uint8_t* frame) {
  return crc16_ccitt_false({frame + kSequence, kCrc - kSequence});
}

}  // namespace

Scan Scanner::scan(const std::uint8_t* first, const std::uint8_t* last) {
  const auto available = static_cast<std::size_t>(last - first);
  if (available > 1 && first[1] != kSync1) return Scan::not_a_frame();
  if (available < kFrameLength) return Scan::incomplete(kFrameLength - available);
  if (crc_of(first) != get_be<std::uint16_t>(first + kCrc)) return Scan::bad_checksum();
  return Scan::frame(kFrameLength, kImu);
}

std::optional<Record> decode_record(Bytes frame) {
  if (frame.size() != kFrameLength || frame[0] != kSync0) return std::nullopt;
  if (Scanner::scan(frame.data(), frame.data() + frame.size()).kind != Scan::Kind::frame) return std::nullopt;
  Record record{frame[kSequence], frame[kStatus], {}};
  for (std::size_t i = 0; i < record.raw.size(); ++i)
    record.raw[i] = get_be<std::uint16_t>(&frame[kChannels + 2 * i]);
  return record;
}

std::array<std::uint8_t, kFrameLength> encode_record(const Record& record) {
  std::array<std::uint8_t, kFrameLength> frame{kSync0, kSync1, record.sequence, record.status};
  for (std::size_t i = 0; i < record.raw.size(); ++i) put_be(&frame[kChannels + 2 * i], record.raw[i]);
  put_be(&frame[kCrc], crc_of(frame.data()));
  return frame;
}

}  // namespace navcal::protocols::imu_card
