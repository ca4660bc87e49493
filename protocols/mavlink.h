// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "protocols/frame.h"
#include "protocols/stream_parser.h"
#include "protocols/wire_fields.h"

/// MAVLink, versions 1 and 2 (ICD, "MAVLink").
namespace navcal::protocols::mavlink {

inline constexpr std::uint8_t kAutopilot = 1;    ///< the component
inline constexpr std::uint8_t kNoAutopilot = 8;  ///< in a heartbeat

/// Constants of a message for its checksum (minimal.xml, common.xml, ardupilotmega.xml).
struct MessageInfo {
  std::string_view name;
  std::uint32_t id = 0;
  std::uint8_t crc_extra = 0;
  std::uint8_t length = 0;  ///< of the payload with all extensions
};
/// nullptr: unknown.
[[nodiscard]] const MessageInfo* message_of(std::uint32_t id);

struct Message {
  std::uint32_t id = 0;
  std::uint8_t system = 0, component = 0;
  const MessageInfo* info = nullptr;  ///< nullptr: unknown, and the checksum was not checked
  bool is_signed = false;             ///< the signature is not checked
  /// The checksum is that of the payload before the zeros at its end were cut (BlueOS up to 2023).
  bool is_untrimmed = false;
  std::size_t length = 0;  ///< of the whole frame
  Bytes payload;           ///< version 2: without the zeros that the sender has left out

  /// "ATTITUDE", or "MSG 4711".
  [[nodiscard]] std::string name() const;
};

struct Found {
  using Verdict = Scan::Kind;
  Verdict verdict = Verdict::not_a_frame;
  Message message{};
  std::size_t missing = 0;  ///< at least, while it is incomplete
};
/// The frame at the beginning of `bytes`. One with an unknown bit among its incompatibility flags is none.
[[nodiscard]] Found find_message(Bytes bytes);

/// Names of frames are those of their messages, cut at sixteen characters. A frame of an unknown message cannot be
/// checked; of version 1 it is none.
struct Scanner : StartsWith<0xFD, 0xFE> {
  static constexpr std::size_t kMaxFrameLength = 280;
  [[nodiscard]] static Scan scan(const std::uint8_t* first, const std::uint8_t* last);
};
using Parser = StreamParser<Scanner>;

/// A payload as it was before the zeros at its end were left out.
class Payload {
 public:
  explicit Payload(Bytes sent) {
    std::copy_n(sent.begin(), std::min<std::size_t>(sent.size(), 255), bytes_.begin());
  }
  template <class T>
  [[nodiscard]] T at(std::size_t offset) const {
    return get_le<T>(bytes_.data() + offset);
  }
  template <class T>
  [[nodiscard]] std::array<double, 3> vector(std::size_t offset, double factor) const {
    return {factor * at<T>(offset), factor * at<T>(offset + sizeof(T)), factor * at<T>(offset + 2 * sizeof(T))};
  }
  [[nodiscard]] std::string text(std::size_t offset, std::size_t length) const;

 private:
  std::array<std::uint8_t, 264> bytes_{};
};

struct Sender {
  std::uint8_t system = 0, component = 0, sequence = 0;
};
/// A frame of version 2 without a signature. `id` must be known.
[[nodiscard]] std::vector<std::uint8_t> encode(std::uint32_t id, Sender sender, Bytes payload);
/// Appends the checksum to a frame of version 2 that ends with its payload.
void append_checksum(std::vector<std::uint8_t>& frame, std::uint32_t id);
/// `type`: 6 a ground station, 18 an onboard controller.
[[nodiscard]] std::vector<std::uint8_t> encode_heartbeat(Sender sender, std::uint8_t type);

/// A parameter of an autopilot. PX4 sends an integer as its four bytes (`is_bytewise`), ArduPilot as a float.
struct Parameter {
  static constexpr std::uint8_t kInt32 = 6, kFloat = 9;
  std::string name;  ///< at most 16 characters
  std::uint8_t type = kFloat;
  double value = 0;
};
[[nodiscard]] Parameter parameter_of(const Message& parameter_value, bool is_bytewise);
/// PARAM_SET and, by the name, PARAM_REQUEST_READ for the autopilot of system `vehicle`.
[[nodiscard]] std::vector<std::uint8_t> encode_setting(Sender sender, std::uint8_t vehicle,
                                                       const Parameter& parameter, bool is_bytewise);
[[nodiscard]] std::vector<std::uint8_t> encode_reading(Sender sender, std::uint8_t vehicle, std::string_view name);

}  // namespace navcal::protocols::mavlink
