// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "protocols/frame.h"
#include "protocols/nmea.h"
#include "protocols/stream_parser.h"

/// u-blox receivers. Manual, not at hand (ICD): u-blox interface descriptions M8 (UBX-13003221), F9
/// (UBX-18010854), chapter "UBX protocol": B5 62, class, id, payload length (u16 LE), payload, Fletcher over class
/// to payload (ICD section 6).
namespace navcal::protocols::ubx {

/// Class and number of a message, as `0x0107` for NAV-PVT.
using MessageCode = std::uint16_t;

inline constexpr MessageCode kNavDop = 0x0104, kNavPvt = 0x0107, kNavTimeGps = 0x0120, kNavSat = 0x0135;
inline constexpr MessageCode kNavAtt = 0x0105, kNavRelPosNed = 0x013C, kHnrPvt = 0x2800, kHnrAtt = 0x2801;
inline constexpr MessageCode kAckNak = 0x0500, kAckAck = 0x0501;
inline constexpr MessageCode kCfgMsg = 0x0601, kCfgRate = 0x0608, kCfgValset = 0x068A;
inline constexpr MessageCode kMonVer = 0x0A04, kTimTp = 0x0D01;

inline constexpr std::size_t kOverhead = 8;  ///< sync, class, id, length, checksum
/// The format allows 65535. The longest message in use, RXM-RAWX with 127 measurements, has 4080; a wrong length
/// must not hold the parser for longer.
inline constexpr std::size_t kMaxPayload = 4096;
inline constexpr std::size_t kMaxRtcm3 = 1029;

inline constexpr FrameId kRtcm3{"RTCM3"};

/// "NAV-PVT"; empty for a message without a name here.
[[nodiscard]] std::string_view name_of(MessageCode code);
/// The identifier of the frame of a message: its name, or class and number in hexadecimal ("0199").
[[nodiscard]] FrameId id_of(MessageCode code);
/// Class and number of a UBX frame; nullopt for a frame of another kind.
[[nodiscard]] std::optional<MessageCode> code_of(const Frame& frame);
/// Payload of an intact UBX frame.
[[nodiscard]] inline Bytes payload_of(Bytes frame) { return frame.subspan(6, frame.size() - kOverhead); }
/// The same of a frame of this message, if it is long enough.
[[nodiscard]] std::optional<Bytes> payload_if(Bytes frame, MessageCode code, std::size_t least);

/// Frames of UBX alone.
struct Scanner : StartsWith<0xB5> {
  static constexpr std::size_t kMaxFrameLength = kOverhead + kMaxPayload;
  static Scan scan(const std::uint8_t* first, const std::uint8_t* last);
};
using Parser = StreamParser<Scanner>;

/// RTCM 10403.3, section 4: D3, six zero bits, length (10 bits), message, CRC-24Q. Corrections are found so that
/// they are accounted for; they are not decoded.
struct Rtcm3Scanner : StartsWith<0xD3> {
  static constexpr std::size_t kMaxFrameLength = kMaxRtcm3;
  static Scan scan(const std::uint8_t* first, const std::uint8_t* last);
};

enum class Kind : std::uint8_t { ubx, nmea, rtcm3 };
/// Kind of a frame of a PortParser.
[[nodiscard]] Kind kind_of(const Frame& frame);

/// A port of the receiver, where UBX, NMEA and RTCM3 may be interleaved; each byte is in one frame or in none.
struct PortScanner : StartsWith<0xB5, '$', 0xD3, '!'> {
  static constexpr std::size_t kMaxFrameLength = std::max(Scanner::kMaxFrameLength, nmea::kMaxLength);
  static Scan scan(const std::uint8_t* first, const std::uint8_t* last);
};
using PortParser = StreamParser<PortScanner>;

/// The frame of a message; the payload has at most kMaxPayload bytes.
[[nodiscard]] std::vector<std::uint8_t> encode_frame(MessageCode code, Bytes payload);

}  // namespace navcal::protocols::ubx
