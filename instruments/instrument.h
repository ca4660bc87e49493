// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "config/settings.h"
#include "instruments/samples.h"
#include "protocols/frame.h"

namespace navcal::instruments {

using Value = decltype(Sample::value);

/// When a measurement was valid, as the program says that has sent it. It places the measurement and defines no
/// clock.
struct SenderTime {
  std::optional<std::int64_t> utc_ns;  ///< absent: the arrival counts
  std::optional<std::int64_t> std_ns;  ///< one standard deviation
};

/// Content of one frame, or of the epoch that it closes, before it is stamped.
struct Measurement {
  Value value{};
  std::optional<std::uint8_t> sequence{};  ///< the device's own counter
  /// Time of validity by the device's own clock, whatever its origin. A line between this clock and the arrivals
  /// then gives the time of the sample, also where the sample does not pace.
  std::optional<std::int64_t> device_time_ns{};
  std::optional<std::int64_t> stated_utc_ns{};  ///< time that the message itself states (GPS)
  bool utc_is_known = false;                    ///< stated time is UTC and may serve as a clock
  bool in_leap_second = false;                  ///< stated as second 60
  /// One tick of the device's clock (not so for satellites in view). What comes after it from the same frame, and
  /// does not pace, is of the same time.
  bool paces = true;
  /// From the measurement to the first byte on the wire, where the device states it; else the port's latency
  /// holds.
  std::optional<std::int64_t> age_ns{};
  std::optional<SenderTime> by_sender{};  ///< of an injected sample
  /// The measurement was sent from the frame on that had the verdict `begins`, not with this frame alone.
  bool of_epoch = false;
  std::uint8_t clock = 0;  ///< of several clocks at one port: that of device_time_ns
};

/// Takes measurements as they are found.
class Receiver {
 public:
  virtual ~Receiver() = default;
  virtual void on_measurement(const Measurement& measurement) = 0;
};

/// Hands over a value of which nothing else is known. `paces` as in Measurement.
inline void hand_over(const Value& value, Receiver& receiver, bool paces = true) {
  receiver.on_measurement({.value = value, .paces = paces});
}

/// One device: converts frames to SI units by configuration. Its state is only what spans frames (epochs, leap
/// seconds). No clock.
class Instrument {
 public:
  /// `begins`: used, and the first frame of an epoch. `foreign`: of another device on the same line. The last
  /// three: its signature is missing, wrong, or of a message that came before.
  enum class Verdict : std::uint8_t { used, begins, ignored, foreign, out_of_range, unsigned_, forged, replayed };

  virtual ~Instrument() = default;
  virtual Verdict read(const protocols::Frame& frame, Receiver& receiver) = 0;
  /// Fields were handed over as an autopilot has corrected them.
  [[nodiscard]] virtual bool has_corrected_fields() const { return false; }
};

using Verdict = Instrument::Verdict;

[[nodiscard]] std::unique_ptr<Instrument> make_instrument(const config::PortSettings& settings);

}  // namespace navcal::instruments
