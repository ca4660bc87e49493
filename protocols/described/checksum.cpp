// SPDX-License-Identifier: Apache-2.0
#include "protocols/described/checksum.h"

#include "protocols/checked_line.h"
#include "protocols/crc16.h"
#include "protocols/fletcher.h"

namespace navcal::protocols::described {
namespace {

struct SumInfo {
  std::string_view name{};
  std::size_t size = 0;
};

/// In the order of Sum.
constexpr std::array<SumInfo, kSumCount> kSums{{{"none", 0},
                                                {"sum8", 1},
                                                {"negated-sum8", 1},
                                                {"sum16", 2},
                                                {"xor8", 1},
                                                {"fletcher16", 2},
                                                {"crc8", 1},
                                                {"crc16-ccitt", 2},
                                                {"crc16-xmodem", 2},
                                                {"crc16-modbus", 2},
                                                {"crc32", 4}}};

template <class Remainder>
constexpr std::array<Remainder, 256> reflected_table(Remainder polynomial) {
  std::array<Remainder, 256> table{};
  for (unsigned byte = 0; byte < 256; ++byte) {
    auto remainder = static_cast<Remainder>(byte);
    for (int bit = 0; bit < 8; ++bit) {
      const bool carries = (remainder & 1U) != 0;
      remainder = static_cast<Remainder>(remainder >> 1);
      if (carries) remainder = static_cast<Remainder>(remainder ^ polynomial);
    }
    table[byte] = remainder;
  }
  return table;
}

constexpr auto kCrc16Modbus = reflected_table<std::uint16_t>(0xA001);
constexpr auto kCrc32 = reflected_table<std::uint32_t>(0xEDB88320);

constexpr auto kCrc8 = [] {
  std::array<std::uint8_t, 256> table{};
  for (unsigned byte = 0; byte < 256; ++byte) {
    unsigned remainder = byte;
    for (int bit = 0; bit < 8; ++bit)
      remainder = (remainder & 0x80U) != 0 ? (remainder << 1) ^ 0x07U : remainder << 1;
    table[byte] = static_cast<std::uint8_t>(remainder);
  }
  return table;
}();

std::uint32_t plain_sum(Bytes bytes) {
  std::uint32_t sum = 0;
  for (const std::uint8_t byte : bytes) sum += byte;
  return sum;
}

template <class Remainder>
Remainder reflected_crc(const std::array<Remainder, 256>& table, Remainder crc, Bytes bytes) {
  for (const std::uint8_t byte : bytes)
    crc = static_cast<Remainder>((crc >> 8) ^ table[static_cast<std::uint8_t>(crc ^ byte)]);
  return crc;
}

}  // namespace

std::string_view name_of(Sum sum) { return kSums.at(static_cast<std::size_t>(sum)).name; }

std::optional<Sum> sum_named(std::string_view name) {
  for (std::size_t i = 0; i < kSums.size(); ++i) {
    if (kSums[i].name == name) return static_cast<Sum>(i);
  }
  return std::nullopt;
}

std::size_t size_of(Sum sum) { return kSums.at(static_cast<std::size_t>(sum)).size; }

std::uint32_t sum_of(Sum sum, Bytes bytes) {
  switch (sum) {
    case Sum::none: break;
    case Sum::sum8: return plain_sum(bytes) & 0xFFU;
    case Sum::negated_sum8: return (0U - plain_sum(bytes)) & 0xFFU;
    case Sum::sum16: return plain_sum(bytes) & 0xFFFFU;
    case Sum::xor8: return xor_of(bytes);
    case Sum::fletcher16: {
      const Fletcher sums = fletcher_of(bytes);
      return static_cast<std::uint32_t>(sums.first << 8 | sums.second);
    }
    case Sum::crc8: {
      std::uint8_t crc = 0;
      for (const std::uint8_t byte : bytes) crc = kCrc8[crc ^ byte];
      return crc;
    }
    case Sum::crc16_ccitt: return crc16_ccitt_false(bytes);
    case Sum::crc16_xmodem: return crc16_xmodem(bytes);
    case Sum::crc16_modbus: return reflected_crc<std::uint16_t>(kCrc16Modbus, 0xFFFF, bytes);
    case Sum::crc32: return ~reflected_crc<std::uint32_t>(kCrc32, 0xFFFFFFFF, bytes);
  }
  return 0;
}

}  // namespace navcal::protocols::described
