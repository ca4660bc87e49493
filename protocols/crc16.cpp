// SPDX-License-Identifier: Apache-2.0
#include "protocols/crc16.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace navcal::protocols {
namespace {

constexpr std::size_t kSlices = 8;
using Table = std::array<std::uint16_t, 256>;

/// [k][b]: what byte b contributes to the remainder when k more bytes follow it. The eight look-ups of a slice do
/// not wait for one another, as those of the byte-wise method do. Reflected: with the bits in reverse order, those
/// of the polynomial too.
template <unsigned Polynomial, bool IsReflected>
constexpr auto kTables = [] {
  std::array<Table, kSlices> tables{};
  for (unsigned byte = 0; byte < 256; ++byte) {
    unsigned remainder = IsReflected ? byte : byte << 8;
    for (int bit = 0; bit < 8; ++bit) {
      const bool carries = (remainder & (IsReflected ? 1U : 0x8000U)) != 0;
      remainder = (IsReflected ? remainder >> 1 : remainder << 1) ^ (carries ? Polynomial : 0);
    }
    tables[0][byte] = static_cast<std::uint16_t>(remainder);
  }
  for (std::size_t k = 1; k < kSlices; ++k) {
    for (std::size_t byte = 0; byte < 256; ++byte) {
      const unsigned shorter = tables[k - 1][byte], low = shorter & 0xFFU, high = shorter >> 8;
      const unsigned rest = IsReflected ? high ^ tables[0][low] : low << 8 ^ tables[0][high];
      tables[k][byte] = static_cast<std::uint16_t>(rest);
    }
  }
  return tables;
}();

template <unsigned Polynomial, bool IsReflected>
std::uint16_t crc16(unsigned crc, Bytes bytes) {
  constexpr auto& kOfPolynomial = kTables<Polynomial, IsReflected>;
  const std::uint8_t* p = bytes.data();
  for (std::size_t left = bytes.size(); left > 0;) {
    // Frames may be shorter than a slice: the look-ups of the rest do not wait for one another either.
    const std::size_t slice = std::min(left, kSlices);
    const unsigned low = crc & 0xFFU, high = crc >> 8;
    crc = kOfPolynomial[slice - 1][(IsReflected ? low : high) ^ p[0]];
    const unsigned rest = IsReflected ? high : low;
    crc ^= slice > 1 ? kOfPolynomial[slice - 2][rest ^ p[1]] : IsReflected ? rest : rest << 8;
    for (std::size_t i = 2; i < slice; ++i) crc ^= kOfPolynomial[slice - 1 - i][p[i]];
    p += slice;
    left -= slice;
  }
  return static_cast<std::uint16_t>(crc);
}

/// Remainders of up to 32 bits; one that is not reflected lies in the uppermost bits.
template <std::uint32_t Polynomial, bool IsReflected>
constexpr auto kByteTable = [] {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t byte = 0; byte < 256; ++byte) {
    std::uint32_t remainder = IsReflected ? byte : byte << 24;
    for (int bit = 0; bit < 8; ++bit) {
      const bool carries = (remainder & (IsReflected ? 1U : 0x80000000U)) != 0;
      remainder = (IsReflected ? remainder >> 1 : remainder << 1) ^ (carries ? Polynomial : 0);
    }
    table[byte] = remainder;
  }
  return table;
}();

template <std::uint32_t Polynomial, bool IsReflected>
std::uint32_t crc_by_bytes(std::uint32_t crc, Bytes bytes) {
  for (const std::uint8_t byte : bytes)
    crc = (IsReflected ? crc >> 8 : crc << 8) ^
          kByteTable<Polynomial, IsReflected>[static_cast<std::uint8_t>((IsReflected ? crc : crc >> 24) ^ byte)];
  return crc;
}

}  // namespace

std::uint16_t crc16_ccitt_false(Bytes bytes) { return crc16<0x1021, false>(0xFFFF, bytes); }

std::uint16_t crc16_xmodem(Bytes bytes) { return crc16<0x1021, false>(0, bytes); }

std::uint16_t crc16_modbus(Bytes bytes) { return crc16<0xA001, true>(0xFFFF, bytes); }

std::uint16_t crc16_mcrf4xx(Bytes bytes) { return crc16<0x8408, true>(0xFFFF, bytes); }

std::uint8_t crc8(Bytes bytes) {
  return static_cast<std::uint8_t>(crc_by_bytes<0x07000000, false>(0, bytes) >> 24);
}

std::uint32_t crc24q(Bytes bytes) { return crc_by_bytes<0x864CFB00, false>(0, bytes) >> 8; }

std::uint32_t crc32(Bytes bytes) { return ~crc_by_bytes<0xEDB88320, true>(0xFFFFFFFF, bytes); }

}  // namespace navcal::protocols
