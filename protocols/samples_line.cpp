// SPDX-License-Identifier: Apache-2.0
#include "protocols/samples_line.h"

namespace navcal::protocols::samples_line {

Scan Scanner::scan(const std::uint8_t* first, const std::uint8_t* last) {
  const std::uint8_t* const limit =
      first + std::min<std::size_t>(static_cast<std::size_t>(last - first), kMaxLength);
  // A control character other than the end of the line is noise: JSON writes it as an escape.
  const std::uint8_t* const end =
      std::find_if(first, limit, [](std::uint8_t byte) { return byte < 0x20 && byte != '\r' && byte != '\t'; });
  if (end == limit)
    return static_cast<std::size_t>(limit - first) == kMaxLength ? Scan::not_a_frame() : Scan::incomplete(1);
  if (*end != '\n') return Scan::not_a_frame();
  const std::uint8_t* close = end;
  while (close[-1] == '\r' || close[-1] == '\t' || close[-1] == ' ') --close;  // the brace at `first` ends it
  if (close[-1] != '}') return Scan::not_a_frame();
  return Scan::frame(static_cast<std::size_t>(end - first) + 1, kSample);
}

}  // namespace navcal::protocols::samples_line
