// SPDX-License-Identifier: Apache-2.0
#include "protocols/crc16.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace navcal::protocols {
namespace {

constexpr std::size_t kSlices = 8;
using Table = std::array<std::uint16_t, 256>;

/// kTables[k][b]: what byte b contributes to the remainder when k more bytes follow it. The eight look-ups of a
/// slice do not wait for one another, as those of the byte-wise method do.
constexpr auto kTables = [] {
  std::array<Table, kSlices> tables{};
  for (unsigned byte = 0; byte < 256; ++byte) {
    unsigned remainder = byte << 8;
    for (int bit = 0; bit < 8; ++bit) {
      remainder = (remainder & 0x8000U) != 0 ? (remainder << 1) ^ 0x1021U : remainder << 1;
    }
    tables[0][byte] = static_cast<std::uint16_t>(remainder);
  }
  for (std::size_t k = 1; k < kSlices; ++k) {
    for (std::size_t byte = 0; byte < 256; ++byte) {
      const unsigned shorter = tables[k - 1][byte];
      tables[k][byte] = static_cast<std::uint16_t>((shorter << 8) ^ tables[0][shorter >> 8]);
    }
  }
  return tables;
}();

/// The same with the bits in reverse order, those of the polynomial too.
template <unsigned Polynomial>
constexpr auto kReflectedTables = [] {
  std::array<Table, kSlices> tables{};
  for (unsigned byte = 0; byte < 256; ++byte) {
    unsigned remainder = byte;
    for (int bit = 0; bit < 8; ++bit)
      remainder = (remainder & 1U) != 0 ? remainder >> 1 ^ Polynomial : remainder >> 1;
    tables[0][byte] = static_cast<std::uint16_t>(remainder);
  }
  for (std::size_t k = 1; k < kSlices; ++k) {
    for (std::size_t byte = 0; byte < 256; ++byte) {
      const unsigned shorter = tables[k - 1][byte];
      tables[k][byte] = static_cast<std::uint16_t>((shorter >> 8) ^ tables[0][shorter & 0xFFU]);
    }
  }
  return tables;
}();

/// Remainder after `bytes`, from that of the bytes before them.
std::uint16_t continued(unsigned crc, Bytes bytes) {
  const std::uint8_t* p = bytes.data();
  std::size_t left = bytes.size();
  for (; left >= kSlices; left -= kSlices, p += kSlices) {
    crc = static_cast<unsigned>(kTables[7][(crc >> 8) ^ p[0]] ^ kTables[6][(crc & 0xFFU) ^ p[1]] ^
                                kTables[5][p[2]] ^ kTables[4][p[3]] ^ kTables[3][p[4]] ^ kTables[2][p[5]] ^
                                kTables[1][p[6]] ^ kTables[0][p[7]]);
  }
  for (; left > 0; --left, ++p) {
    crc = ((crc << 8) & 0xFFFFU) ^ kTables[0][(crc >> 8) ^ *p];
  }
  return static_cast<std::uint16_t>(crc);
}

template <unsigned Polynomial>
std::uint16_t reflected(Bytes bytes) {
  constexpr auto& kOfPolynomial = kReflectedTables<Polynomial>;
  unsigned crc = 0xFFFF;
  const std::uint8_t* p = bytes.data();
  for (std::size_t left = bytes.size(); left > 0;) {
    // Most frames are shorter than a few slices: the look-ups of the rest do not wait for one another either.
    const std::size_t slice = std::min(left, kSlices);
    unsigned next = kOfPolynomial[slice - 1][(crc & 0xFFU) ^ p[0]];
    next ^= slice > 1 ? kOfPolynomial[slice - 2][(crc >> 8) ^ p[1]] : crc >> 8;
    for (std::size_t i = 2; i < slice; ++i) next ^= kOfPolynomial[slice - 1 - i][p[i]];
    crc = next;
    p += slice;
    left -= slice;
  }
  return static_cast<std::uint16_t>(crc);
}

}  // namespace

std::uint16_t crc16_ccitt_false(Bytes bytes) { return continued(0xFFFF, bytes); }

std::uint16_t crc16_xmodem(Bytes bytes) { return continued(0, bytes); }

std::uint16_t crc16_modbus(Bytes bytes) { return reflected<0xA001>(bytes); }

std::uint16_t crc16_mcrf4xx(Bytes bytes) { return reflected<0x8408>(bytes); }

}  // namespace navcal::protocols
