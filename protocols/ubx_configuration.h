// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "protocols/ubx.h"

/// Configuration of a receiver and its answers (u-blox interface description F9, sections "UBX-CFG", "UBX-ACK" and
/// "Configuration interface").
namespace navcal::protocols::ubx {

/// ACK-ACK or ACK-NAK: whether a message of class CFG was carried out.
struct Acknowledgement {
  MessageCode code = 0;  ///< of the message that is answered
  bool accepted = false;
  bool operator==(const Acknowledgement&) const = default;
};
[[nodiscard]] std::optional<Acknowledgement> decode_acknowledgement(Bytes frame);
[[nodiscard]] std::vector<std::uint8_t> encode_acknowledgement(const Acknowledgement& acknowledgement);

/// CFG-MSG: how often a message is sent on the port that carries the command; receivers up to generation 8.
struct MessageRate {
  MessageCode code = 0;
  std::uint8_t epochs = 0;  ///< every so many; 0: never
  bool operator==(const MessageRate&) const = default;
};
[[nodiscard]] std::optional<MessageRate> decode_cfg_msg(Bytes frame);
[[nodiscard]] std::vector<std::uint8_t> encode_cfg_msg(const MessageRate& rate);

/// CFG-RATE: time between two epochs, and epochs between two solutions; receivers up to generation 8.
struct EpochRate {
  std::uint16_t interval_ms = 0;
  std::uint16_t epochs = 1;  ///< measured for each solution
  bool operator==(const EpochRate&) const = default;
};
[[nodiscard]] std::optional<EpochRate> decode_cfg_rate(Bytes frame);
/// The epochs are aligned to UTC.
[[nodiscard]] std::vector<std::uint8_t> encode_cfg_rate(const EpochRate& rate);

/// One item of CFG-VALSET. The size of a value is in bits 28 to 30 of its key.
struct ConfigurationItem {
  std::uint32_t key = 0;
  std::uint64_t value = 0;
  bool operator==(const ConfigurationItem&) const = default;
};
/// Bytes of the value of a key: 1, 2, 4 or 8; 0 when the key has no valid size.
[[nodiscard]] constexpr std::size_t value_size(std::uint32_t key) {
  switch (key >> 28 & 7U) {
    case 1:  // one bit, sent as a byte
    case 2: return 1;
    case 3: return 2;
    case 4: return 4;
    case 5: return 8;
    default: return 0;
  }
}

// Keys of generations 9 and 10 that the start-up needs.
inline constexpr std::uint32_t kRateMeasurement_ms = 0x30210001;  ///< CFG-RATE-MEAS
inline constexpr std::uint32_t kRateNavigation = 0x30210002;      ///< CFG-RATE-NAV

/// A port of the receiver. The number is the place of its key after that of UART1, where messages are concerned.
enum class ReceiverPort : std::uint8_t { uart1 = 0, uart2 = 1, usb = 2 };

/// CFG-UART1OUTPROT-UBX, CFG-UART2OUTPROT-UBX, CFG-USBOUTPROT-UBX: UBX on this port; the key of NMEA is one more.
[[nodiscard]] constexpr std::uint32_t key_of_ubx_output(ReceiverPort port) {
  return 0x10740001 + 0x20000 * static_cast<std::uint32_t>(port);
}
[[nodiscard]] constexpr std::uint32_t key_of_nmea_output(ReceiverPort port) { return key_of_ubx_output(port) + 1; }
/// CFG-MSGOUT-UBX_NAV_PVT_UART1 and so on: epochs between two of this message on this port; 0 for a message whose
/// key is not known here.
[[nodiscard]] constexpr std::uint32_t key_of_message(MessageCode code, ReceiverPort port) {
  const std::uint32_t uart1 = code == kNavPvt       ? 0x20910007
                              : code == kNavTimeGps ? 0x20910048
                              : code == kNavDop     ? 0x20910039
                              : code == kNavSat     ? 0x20910016
                                                    : 0;
  return uart1 == 0 ? 0 : uart1 + static_cast<std::uint32_t>(port);
}

enum Layer : std::uint8_t { ram = 1, battery_backed = 2, flash = 4 };

inline constexpr std::size_t kMaxItems = 64;  ///< of one CFG-VALSET

struct ValueSet {
  std::uint8_t layers = Layer::ram;  ///< OR of Layer
  std::vector<ConfigurationItem> items;
  bool operator==(const ValueSet&) const = default;
};
/// CFG-VALSET without transaction; nullopt when an item has no valid size or is cut short.
[[nodiscard]] std::optional<ValueSet> decode_cfg_valset(Bytes frame);
/// At most kMaxItems items, each with a valid size; values are cut to the size of their key.
[[nodiscard]] std::vector<std::uint8_t> encode_cfg_valset(std::uint8_t layers,
                                                          std::span<const ConfigurationItem> items);

}  // namespace navcal::protocols::ubx
