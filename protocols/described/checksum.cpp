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

std::uint32_t plain_sum(Bytes bytes) {
  std::uint32_t sum = 0;
  for (const std::uint8_t byte : bytes) sum += byte;
  return sum;
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
    case Sum::crc8: return crc8(bytes);
    case Sum::crc16_ccitt: return crc16_ccitt_false(bytes);
    case Sum::crc16_xmodem: return crc16_xmodem(bytes);
    case Sum::crc16_modbus: return crc16_modbus(bytes);
    case Sum::crc32: return crc32(bytes);
  }
  return 0;
}

}  // namespace navcal::protocols::described
