// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "protocols/frame.h"
#include "protocols/stream_parser.h"

/// The narrow link between a vehicle and its operator (docs/remote.md): frames, sessions and reports as values. No
/// clock and no port: whoever owns an end gives it bytes and the time, and takes bytes from it.
namespace navcal::link {

using protocols::Bytes;
using Buffer = std::vector<std::uint8_t>;

/// Numbers as on the wire; 0 is none.
enum class FrameType : std::uint8_t {
  hello = 1,  ///< operator: a new session, please
  welcome,    ///< vehicle: the session's number and secret-free start values
  refusal,    ///< vehicle: why a frame was refused
  bye,        ///< operator: the session ends in good order
  ping,       ///< operator: is alive
  pong,       ///< vehicle: answer to a ping
  report,     ///< vehicle: the state in short
  command,    ///< operator: lease, order or release of the motor, or stop
  answer,     ///< vehicle: answer to a command
  segment,    ///< both: a piece of the reliable stream
  ack,        ///< both: which pieces have come
};
inline constexpr std::uint8_t kFrameTypes = 11;

inline constexpr std::uint8_t kSync0 = 0xD2;
inline constexpr std::uint8_t kSync1 = 0x4E;
inline constexpr std::uint8_t kVersion = 1;
inline constexpr std::size_t kMaxPayload = 200;
inline constexpr std::size_t kHeaderLength = 10;
inline constexpr std::size_t kTagLength = 8;
inline constexpr std::size_t kCrcLength = 4;
inline constexpr std::size_t kMaxFrame = kHeaderLength + kMaxPayload + kTagLength + kCrcLength;

/// A sync pair may occur inside a frame, so a frame is one only by its CRC-32.
struct Scanner : protocols::StartsWith<kSync0> {
  static constexpr std::size_t kMaxFrameLength = kMaxFrame;
  static protocols::Scan scan(const std::uint8_t* first, const std::uint8_t* last);
};
using Parser = protocols::StreamParser<Scanner>;

struct Header {
  FrameType type = FrameType::ping;
  bool is_tagged = false;
  std::uint16_t session = 0;  ///< 0: outside any session
  std::uint32_t counter = 0;  ///< grows with every frame of a session and direction

  bool operator==(const Header&) const = default;
};

/// An intact frame taken apart. The spans point into the frame.
struct FrameView {
  Header header;
  Bytes payload;
  Bytes covered;  ///< what the tag covers: all between the sync bytes and the tag
  Bytes tag;      ///< empty without one
};

/// Takes apart what the parser found; nullopt when `frame` is no intact frame.
[[nodiscard]] std::optional<FrameView> view_frame(Bytes frame);

/// A frame under construction: begin, let the tag be made of covered(), finish.
class FrameWriter {
 public:
  /// `payload`: at most kMaxPayload bytes; the rest is cut.
  FrameWriter(const Header& header, Bytes payload);
  [[nodiscard]] Bytes covered() const { return Bytes(bytes_).subspan(2); }
  /// `tag`: kTagLength bytes if the header says that there is one, else nothing.
  [[nodiscard]] Buffer finish(Bytes tag) &&;

 private:
  Buffer bytes_;
};

}  // namespace navcal::link
