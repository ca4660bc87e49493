// SPDX-License-Identifier: Apache-2.0
#include "record/log/message_crc.h"

#include "protocols/decimal.h"
#include "record/log/checksum.h"
#include "record/log/mcap_format.h"

namespace navcal::record {

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
