// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "protocols/keller.h"
#include "protocols/paroscientific.h"
#include "tests/protocols/samples.h"

// Random frames of pressure gauges.
namespace navcal::protocols::test {

template <>
inline Buffer random_frame<paroscientific::Scanner>(Random& random) {
  const auto text = [&]() -> std::string {
    switch (below(random, 4)) {
      case 0: return "UN=" + std::to_string(below(random, 9));
      case 1: return "P4";
      case 2: return "VR=R5.10 (c), 2010";
      default: return std::to_string(below(random, 2000)) + "." + std::to_string(10000 + below(random, 90000));
    }
  }();
  Buffer line = paroscientific::encode_line(
      {static_cast<std::uint8_t>(below(random, 100)), static_cast<std::uint8_t>(below(random, 100))}, text);
  if (chance(random)) line.erase(line.end() - 2);
  return line;
}

inline keller::Reading random_reading(Random& random) {
  const auto address = static_cast<std::uint8_t>(1 + below(random, 250));
  return {address, static_cast<float>(below(random, 1000000)) * 1e-4F, static_cast<std::uint8_t>(random())};
}

template <>
inline Buffer random_frame<keller::Scanner>(Random& random) {
  const auto address = static_cast<std::uint8_t>(1 + below(random, 250));
  switch (below(random, 5)) {
    case 0: return keller::initialise_request(address);
    case 1: return keller::read_request(address, static_cast<std::uint8_t>(below(random, 6)));
    case 2:
      return keller::encode(
          keller::Identity{address, 5, 20, 12, 10, 13, static_cast<std::uint8_t>(below(random, 2))});
    case 3: return keller::encode(keller::Refusal{address, keller::kReadChannel, keller::kNotInitialised});
    default: return keller::encode(random_reading(random));
  }
}

}  // namespace navcal::protocols::test
