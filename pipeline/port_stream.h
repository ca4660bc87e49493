// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <optional>

#include "config/settings.h"
#include "instruments/clock_state.h"
#include "instruments/frame_clock.h"
#include "instruments/instrument.h"
#include "instruments/mounting.h"
#include "pipeline/arrival_track.h"
#include "pipeline/gps_time_watch.h"
#include "pipeline/pipeline.h"
#include "pipeline/standard_errors.h"
#include "protocols/parsers.h"

namespace navcal::pipeline {

/// Lets in the absolute pressures of one gauge: from the highest mountain lake to the deepest sea. A gauge that
/// measures relative to the air, or to air that is sealed in it, says nearly zero at the surface. After three such
/// readings in a row, which no damaged frame makes, it is not believed below the surface either.
class PressureGate {
 public:
  [[nodiscard]] bool lets_in(double pressure_Pa) {
    constexpr int kRelative = 3;
    if (lows_ < kRelative) lows_ = pressure_Pa < 30e3 ? lows_ + 1 : 0;
    return lows_ == 0 && pressure_Pa <= 150e6;
  }

 private:
  int lows_ = 0;
};

/// One port's way from bytes to stamped samples.
class PortStream : private instruments::Receiver {
 public:
  PortStream(std::uint16_t port, const config::PortSettings& settings, const StandardErrors& errors,
             UtcMapping& mapping);
  PortStream(const PortStream&) = delete;
  PortStream& operator=(const PortStream&) = delete;

  void bytes(std::int64_t arrival_ns, protocols::Bytes bytes, Sink& sink);
  /// Gives up the incomplete candidate.
  void silence(Sink& sink);
  /// When silence() is due: the wire time of what is missing has passed, with a margin. INT64_MAX: nothing is
  /// held.
  [[nodiscard]] std::int64_t deadline_ns() const;
  [[nodiscard]] PortStatistics statistics() const;

 private:
  void on_frame(const protocols::Frame& frame);
  void on_measurement(const instruments::Measurement& measurement) override;
  /// Sets the time of validity of an injected sample. False when it lies too far behind the arrival.
  [[nodiscard]] bool place(const instruments::SenderTime& time, instruments::Stamp& stamp) const;
  void tell_news(instruments::ClockNews news);

  std::uint16_t port_;
  std::int64_t latency_ns_, latency_std_ns_;
  double nominal_rate_Hz_;
  protocols::AnyPortParser parser_;
  ArrivalTrack track_;
  std::unique_ptr<instruments::Instrument> instrument_;
  instruments::Mounting mounting_;
  PressureGate pressures_;
  instruments::FrameClock clock_;
  std::map<std::uint8_t, instruments::FrameClock> others_;  ///< by Measurement::clock
  GpsTimeWatch gps_time_;
  const StandardErrors& errors_;
  UtcMapping& mapping_;
  PortStatistics statistics_;
  std::int64_t last_arrival_ns_ = 0;
  // Sink of the frame being read; set only during a call.
  Sink* sink_ = nullptr;
  ArrivalTrack::Frame place_;
  std::int64_t tick_ns_ = 0;         ///< newest observation given to the clock
  std::int64_t epoch_start_ns_ = 0;  ///< of the frame that began the newest epoch
  // Time of the frame being read, once one of its samples paces: the others of the same frame have it, too.
  std::optional<instruments::TimeEstimate> paced_;
  bool repeated_ = false;
};

}  // namespace navcal::pipeline
