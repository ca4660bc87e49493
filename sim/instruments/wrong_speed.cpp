// SPDX-License-Identifier: Apache-2.0
#include "sim/instruments/wrong_speed.h"

#include <cstddef>

namespace navcal::sim {
namespace {

constexpr std::size_t kBitsOfCharacter = 10;

/// Level of the wire `bit` bits after the first start bit began; idle is one.
bool level(protocols::Bytes sent, std::size_t bit) {
  const std::size_t character = bit / kBitsOfCharacter;
  const std::size_t within = bit % kBitsOfCharacter;
  if (character >= sent.size() || within == kBitsOfCharacter - 1) return true;
  return within != 0 && ((sent[character] >> (within - 1)) & 1U) != 0;
}

}  // namespace

std::vector<std::uint8_t> heard_at(protocols::Bytes sent, int sent_baud, int heard_baud) {
  if (sent_baud == heard_baud) return {sent.begin(), sent.end()};
  std::vector<std::uint8_t> heard;
  const double bit = static_cast<double>(sent_baud) / heard_baud;  // a bit of the receiver, in bits of the sender
  const double end = static_cast<double>(sent.size() * kBitsOfCharacter);
  const auto at = [&](double time) { return level(sent, static_cast<std::size_t>(time)); };
  for (double time = 0; time < end;) {
    if (at(time)) {  // waits for a falling edge, looking sixteen times a bit as UARTs do
      time += bit / 16;
      continue;
    }
    unsigned character = 0;
    for (unsigned i = 0; i < 8; ++i) character |= at(time + bit * (1.5 + i)) ? 1U << i : 0U;
    heard.push_back(at(time + bit * 9.5) ? static_cast<std::uint8_t>(character) : std::uint8_t{0});
    time += bit * 9.5;
  }
  return heard;
}

}  // namespace navcal::sim
