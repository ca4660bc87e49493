// SPDX-License-Identifier: Apache-2.0
#include "protocols/keller.h"

#include <algorithm>
#include <initializer_list>

#include "protocols/crc16.h"
#include "protocols/wire_fields.h"

namespace navcal::protocols::keller {
namespace {

/// A shape that a frame with this function may have: its length with the checksum, and its name.
struct Shape {
  std::size_t length = 0;
  FrameId id;
};

bool sum_holds(const std::uint8_t* first, std::size_t length) {
  return crc16_modbus(Bytes(first, length - 2)) == get_be<std::uint16_t>(first + length - 2);
}

/// Tries the shapes from the shortest to the longest; the first whose checksum holds is the frame.
Scan scan_shapes(const std::uint8_t* first, std::size_t available, std::initializer_list<Shape> shapes) {
  for (const Shape& shape : shapes) {
    if (available < shape.length) return Scan::incomplete(shape.length - available);
    if (sum_holds(first, shape.length)) return Scan::frame(shape.length, shape.id);
  }
  return Scan::bad_checksum();
}

std::vector<std::uint8_t> summed(std::vector<std::uint8_t> frame) {
  append_be(frame, crc16_modbus(frame));
  return frame;
}

constexpr Shape kInitialiseShape{4, kInitialiseRequest}, kIdentityShape{10, kInitialised};
constexpr Shape kRequestShape{5, kReadRequest}, kReadingShape{9, kReading}, kErrorShape{5, kError};

bool has_shape(Bytes frame, const Shape& shape, std::uint8_t function) {
  return frame.size() == shape.length && frame[1] == function;
}

}  // namespace

Scan Scanner::scan(const std::uint8_t* first, const std::uint8_t* last) {
  const auto available = static_cast<std::size_t>(last - first);
  if (available < 2) return Scan::incomplete(2);
  switch (first[1]) {
    case kInitialise: return scan_shapes(first, available, {kInitialiseShape, kIdentityShape});
    case kInitialise | kRefused:
    case kReadChannel | kRefused: return scan_shapes(first, available, {kErrorShape});
    case kReadChannel:
      if (available < 3) return Scan::incomplete(2);
      // The first byte of a pressure's float is no channel, unless the pressure is zero or next to it.
      if (first[2] > kLastChannel) return scan_shapes(first, available, {kReadingShape});
      return scan_shapes(first, available, {kRequestShape, kReadingShape});
    default: return Scan::not_a_frame();
  }
}

std::optional<Reading> decode_reading(Bytes frame) {
  if (!has_shape(frame, kReadingShape, kReadChannel)) return std::nullopt;
  return Reading{frame[0], get_be<float>(&frame[2]), frame[6]};
}

std::optional<Identity> decode_identity(Bytes frame) {
  if (!has_shape(frame, kIdentityShape, kInitialise)) return std::nullopt;
  return Identity{frame[0], frame[2], frame[3], frame[4], frame[5], frame[6], frame[7]};
}

std::optional<Refusal> decode_refusal(Bytes frame) {
  if (frame.size() != kErrorShape.length || (frame[1] & kRefused) == 0) return std::nullopt;
  return Refusal{frame[0], static_cast<std::uint8_t>(frame[1] ^ kRefused), frame[2]};
}

std::optional<std::uint8_t> requested_channel(Bytes frame) {
  if (!has_shape(frame, kRequestShape, kReadChannel)) return std::nullopt;
  return frame[2];
}

std::vector<std::uint8_t> encode(const Reading& reading) {
  std::vector<std::uint8_t> frame{reading.address, kReadChannel, 0, 0, 0, 0, reading.status};
  put_be(&frame[2], reading.value);
  return summed(std::move(frame));
}

std::vector<std::uint8_t> encode(const Identity& identity) {
  return summed({identity.address, kInitialise, identity.device_class, identity.group, identity.year,
                 identity.week, identity.buffer, identity.state});
}

std::vector<std::uint8_t> encode(const Refusal& refusal) {
  return summed({refusal.address, static_cast<std::uint8_t>(refusal.function | kRefused), refusal.error});
}

std::vector<std::uint8_t> initialise_request(std::uint8_t address) { return summed({address, kInitialise}); }

std::vector<std::uint8_t> read_request(std::uint8_t address, std::uint8_t channel) {
  return summed({address, kReadChannel, channel});
}

}  // namespace navcal::protocols::keller
