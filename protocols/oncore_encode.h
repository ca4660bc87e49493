// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "protocols/oncore_messages.h"
#include "protocols/oncore_position.h"

namespace navcal::protocols::oncore {

/// `@@`, the letters, data, checksum, CR LF.
[[nodiscard]] std::vector<std::uint8_t> encode_frame(FrameId id, Bytes data);

// Messages of a receiver, for the emulator and the tests. Values are rounded to the resolution of the message.
// Fields that the message lacks are left out; absent optional ones become 0.
[[nodiscard]] std::vector<std::uint8_t> encode_ha(const Position& position);
[[nodiscard]] std::vector<std::uint8_t> encode_ea(const Position& position);
[[nodiscard]] std::vector<std::uint8_t> encode_bb(const VisibleSatellites& satellites);
[[nodiscard]] std::vector<std::uint8_t> encode_bo(const UtcOffset& offset);
/// Longer texts than the message holds are cut, shorter ones filled with blanks.
[[nodiscard]] std::vector<std::uint8_t> encode_cj(std::string_view text);

}  // namespace navcal::protocols::oncore
