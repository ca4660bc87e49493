// SPDX-License-Identifier: Apache-2.0
#include "record/log/checksum.h"

#include <boost/crc.hpp>

#include "protocols/decimal.h"
#include "record/log/mcap_format.h"

namespace navcal::record {
namespace {

// Boost takes the initial remainder unreflected and without the final xor: undone by hand to continue a sum.
using Crc32c = boost::crc_optimal<32, 0x1EDC6F41, 0, 0, true, true>;
using Crc32 = boost::crc_optimal<32, 0x04C11DB7, 0, 0, true, true>;

std::uint32_t reflected(std::uint32_t value) {
  std::uint32_t result = 0;
  for (int bit = 0; bit < 32; ++bit) result |= ((value >> bit) & 1U) << (31 - bit);
  return result;
}

template <class Crc>
std::uint32_t continued(std::string_view bytes, std::uint32_t before) {
  Crc crc(reflected(~before));
  crc.process_bytes(bytes.data(), bytes.size());
  return ~crc.checksum();
}

}  // namespace

std::uint32_t crc32c(std::string_view bytes, std::uint32_t before) { return continued<Crc32c>(bytes, before); }

std::uint32_t crc32(std::string_view bytes, std::uint32_t before) { return continued<Crc32>(bytes, before); }

bool json_crc_holds(std::string_view data) {
  constexpr std::string_view kBefore = R"(,"crc":")";
  if (data.size() <= kJsonTail || data.front() != '{') return false;
  const std::string_view tail = data.substr(data.size() - kJsonTail);
  if (tail.substr(0, kBefore.size()) != kBefore || tail.substr(kBefore.size() + 8) != "\"}") return false;
  return protocols::integer<std::uint32_t>(tail.substr(kBefore.size(), 8), 16) ==
         crc32c(data.substr(0, data.size() - kJsonTail));
}

bool raw_crc_holds(std::string_view data) {
  if (data.size() < kRawHead + kRawTail || static_cast<unsigned char>(data.front()) > 1) return false;
  const std::size_t summed = data.size() - kRawTail;
  return read_le<std::uint32_t>(data, summed) == crc32c(data.substr(0, summed));
}

}  // namespace navcal::record
