// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/instruments/device.h"
#include "sim/noise.h"

namespace navcal::emulation {

/// "SECONDS@EVERY": silent for so long, every so many seconds.
struct StallPlan {
  double duration_s = 0;
  double every_s = 0;
};
/// "PORT@T+DURATION": pulled out at T seconds after the start, for so long.
struct UnplugPlan {
  std::string port;
  double at_s = 0;
  double duration_s = 0;
};
// nullopt when the text is not of this form or the numbers make no sense.
[[nodiscard]] std::optional<StallPlan> parse_stall(std::string_view text);
[[nodiscard]] std::optional<UnplugPlan> parse_unplug(std::string_view text);

/// Effects of a bad line on frames.
class Misbehaviour {
 public:
  explicit Misbehaviour(std::uint64_t seed) : random_(seed) {}

  void set_noise(double probability) { noise_ = probability; }
  void set_drop(double probability) { drop_ = probability; }
  /// The frame as it goes on the wire: as it is, with a bit flipped, with garbage before it, or not at all
  /// (empty).
  [[nodiscard]] std::vector<std::uint8_t> corrupt(std::vector<std::uint8_t> frame);

 private:
  [[nodiscard]] std::size_t below(std::size_t n);

  sim::Noise random_;
  double noise_ = 0;
  double drop_ = 0;
};

}  // namespace navcal::emulation
