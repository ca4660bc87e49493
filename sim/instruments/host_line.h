// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "sim/effects/effect_set.h"
#include "sim/instruments/device.h"
#include "sim/noise.h"

namespace navcal::sim {

/// A completed read of one instrument's line, or a write to it, as its host records it.
struct LineRead {
  std::int64_t time_ns = 0;  ///< UTC: when the read returned
  Instrument of = Instrument::compass;
  bool sent = false;  ///< by the host
  std::vector<std::uint8_t> bytes;
};

/// Reads of a host from the line of one device. Bytes follow one another at the line's pace (8N1). A read
/// returns the bytes of a frame after every 16 bytes and at its end, after a further delay that is
/// exponentially distributed. Effects lose, repeat or delay frames on the way.
class HostLine {
 public:
  struct Options {
    Instrument of = Instrument::compass;
    double delay_s = 50e-6;  ///< of the host, in the mean
    std::uint64_t seed = 1;
  };
  explicit HostLine(const Options& options) : options_(options), noise_(options.seed) {}

  void take(const Emission& emission, int baud, EffectSet& effects);
  /// Reads that returned up to t_ns, appended in order. What is taken later may return at the same time, not
  /// before it.
  void reads_until(std::int64_t t_ns, std::vector<LineRead>& out);

 private:
  void put(std::int64_t time_ns, protocols::Bytes bytes);

  Options options_;
  Noise noise_;
  std::int64_t free_ns_ = 0;  ///< the last byte is over
  std::int64_t last_ns_ = 0;  ///< of the newest read
  std::deque<LineRead> reads_;
};

}  // namespace navcal::sim
