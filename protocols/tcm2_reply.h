// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "protocols/frame.h"

namespace navcal::protocols::tcm2 {

/// `HnVnMn.n`: what the built-in calibration thinks of itself.
struct CalibrationScore {
  std::uint8_t horizontal = 0;  ///< 0 to 9, coverage: higher is better
  std::uint8_t vertical = 0;    ///< likewise
  double magnitude = 0;         ///< of the hard iron

  bool operator==(const CalibrationScore&) const = default;
};

/// The device's answer to a command. A refusal says nothing of the data words around it.
struct Reply {
  enum class Kind : std::uint8_t {
    accepted,     ///< `:` alone
    refused,      ///< `:E0nn`; see `error`
    value,        ///< `:<parameter>=<value>`
    calibration,  ///< a score, with or without a colon before it
  };
  Kind kind = Kind::accepted;
  std::uint32_t error = 0;
  std::string_view parameter, value;  ///< lie in the bytes that were decoded
  CalibrationScore score;

  bool operator==(const Reply&) const = default;
};

/// Decodes a whole line, with or without CR LF; nullopt if it is no reply.
[[nodiscard]] std::optional<Reply> decode_reply(Bytes line);
[[nodiscard]] std::vector<std::uint8_t> encode_reply(const Reply& reply);

}  // namespace navcal::protocols::tcm2
