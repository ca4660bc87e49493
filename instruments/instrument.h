// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <variant>

#include "config/settings.h"
#include "instruments/samples.h"
#include "protocols/frame.h"

namespace navcal::instruments {

using Value = decltype(Sample::value);

/// Content of one frame, or of the epoch that it closes, before it is stamped.
struct Measurement {
  Value value;
  std::optional<std::uint8_t> sequence;       ///< the device's own counter
  std::optional<std::int64_t> stated_utc_ns;  ///< time that the message itself states (GPS)
  bool utc_is_known = false;                  ///< stated time is UTC and may serve as a clock
  /// It comes from the same frame as the measurement before, which paced the clock, and is of the same time.
  bool of_tick_before = false;
  bool paces = true;  ///< one tick of the device's clock (not so for satellites in view)
};

/// Takes measurements as they are found.
class Receiver {
 public:
  virtual ~Receiver() = default;
  virtual void on_measurement(const Measurement& measurement) = 0;
};

/// One device: converts frames to SI units by configuration. Its state is only what spans frames (epochs, leap
/// seconds). No clock.
class Instrument {
 public:
  enum class Verdict : std::uint8_t { used, ignored, out_of_range };

  virtual ~Instrument() = default;
  virtual Verdict read(const protocols::Frame& frame, Receiver& receiver) = 0;
};

[[nodiscard]] std::unique_ptr<Instrument> make_instrument(const config::PortSettings& settings);

}  // namespace navcal::instruments
