// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "sim/effects/places.h"
#include "sim/noise.h"

namespace navcal::sim {

/// Randomness of each instrument's own, so that what happens to one does not depend on when another is asked.
class InstrumentNoise {
 public:
  void reseed(std::uint64_t seed) {
    for (std::size_t i = 0; i < noises_.size(); ++i) noises_[i] = Noise(seed + i);
  }
  [[nodiscard]] Noise& operator[](Instrument of) { return noises_[static_cast<std::size_t>(of)]; }

 private:
  std::array<Noise, kInstruments> noises_{Noise(1), Noise(2), Noise(3), Noise(4)};
};

}  // namespace navcal::sim
