// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "protocols/mip.h"

/// Commands of a MicroStrain sensor's start-up (ICD section 7), as the host sends them and the emulator reads
/// them.
namespace navcal::protocols::mip {

/// Descriptors of set 0x0C. Older devices (3DM-GX4, -GX5 of some firmware) have one command for each data set,
/// newer ones one command with the set as an argument.
namespace command_3dm {
inline constexpr std::uint8_t kSensorBaseRate = 0x06, kSensorFormat = 0x08, kFilterFormat = 0x0A,
                              kFilterBaseRate = 0x0B, kBaseRate = 0x0E, kFormat = 0x0F, kDataStream = 0x11;
}  // namespace command_3dm

/// Errors of a Reply.
namespace reply_error {
inline constexpr std::uint8_t kNone = 0, kUnknownCommand = 1, kInvalidParameter = 3, kFailed = 4;
}  // namespace reply_error

/// Base rate of a data set: answered in Packet::base_rate. `by_set`: the older command of sensor or filter data.
[[nodiscard]] std::vector<std::uint8_t> encode_base_rate_request(std::uint8_t set, bool by_set);
/// Message format by the older command of sensor or filter data.
[[nodiscard]] std::vector<std::uint8_t> encode_format_by_set(std::uint8_t set,
                                                             const std::vector<FieldRate>& rates);
/// Data stream of one set, on or off. `by_set`: the selector of older devices, 1 sensor, 3 filter.
[[nodiscard]] std::vector<std::uint8_t> encode_data_stream(std::uint8_t set, bool on, bool by_set);

/// Answer to a command, with the base rate where it was asked for.
[[nodiscard]] std::vector<std::uint8_t> encode_reply(std::uint8_t set, const Reply& reply);
[[nodiscard]] std::vector<std::uint8_t> encode_base_rate(const Reply& reply, const BaseRate& rate);

/// All fields of an intact packet. Bytes behind a field whose length cannot be are left.
struct FieldBytes {
  std::uint8_t descriptor = 0;
  Bytes data;  ///< of the packet
};
[[nodiscard]] std::vector<FieldBytes> fields_of(Bytes frame);
/// A list of fields with their decimations: count u8, then descriptor u8 and decimation u16 each. Empty when its
/// length is not right.
[[nodiscard]] std::vector<FieldRate> decode_format(Bytes list);

}  // namespace navcal::protocols::mip
