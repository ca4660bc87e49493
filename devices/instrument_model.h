// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "base/angles.h"
#include "config/settings.h"
#include "protocols/frame.h"
#include "protocols/motor_card.h"

/// Instrument models of one vehicle. The simulator makes its errors from them, the diagnosis compares a
/// recording with them, and navigation and calibrators weight readings with them. The defaults are the
/// reference instruments of docs/simulator.md.
///
/// Noise is white, one standard deviation of a reading. Units are in the names; axes are those of the body (x
/// forward, y starboard, z down).
namespace navcal::devices {

struct Timing {
  double latency_s = 0;      ///< from the measurement to the first byte on the wire
  double latency_std_s = 0;  ///< its uncertainty
  double rate_Hz = 0;        ///< frames a second; positive
  std::int64_t baud = 0;     ///< line speed, bit/s; 64 bits, so that no gap lies between the members
};

/// Usual timing of the device with `protocol` (config::default_port) at this line speed.
[[nodiscard]] Timing usual_timing(protocols::Protocol protocol, int baud);

/// TCM2. Resolutions are those of its words.
struct CompassModel : config::CompassAccuracy {
  double heading_resolution_deg = 0.1;
  double tilt_resolution_deg = 0.1;
  config::MountingSettings mounting;
  Timing timing = usual_timing(protocols::Protocol::tcm2, 38400);

  /// Roll or pitch: noise of a reading, with what rounding adds, rad.
  [[nodiscard]] double tilt_reading_noise_rad() const;
  /// Magnetic heading of a level vehicle in the reference field, from the noise of field and tilt, rad.
  [[nodiscard]] double heading_noise_rad() const;
};

/// Inertial card with gyros, accelerometers and depth gauge.
struct ImuModel : config::ImuAccuracy {
  config::ImuCardSettings channels;  ///< zeros and scales of this unit
  config::MountingSettings mounting;
  Timing timing = usual_timing(protocols::Protocol::imu_card, 57600);
};

/// Receiver: a fix at each full second.
struct GpsModel : config::GpsAccuracy {
  config::MountingSettings mounting;  ///< of the antenna
  Timing timing = usual_timing(protocols::Protocol::oncore, 9600);

  /// Ratio of the noise of fix `number` to that of a settled fix; `number` counts from 0 since sight of the
  /// sky. The first fixes come from few satellites.
  [[nodiscard]] double noise_factor(int number) const { return 1 + excess_noise(number); }
  /// Mean search of a receiver that has been without reception for `unseen_s` since its last fix, s.
  [[nodiscard]] double mean_search_s(double unseen_s) const;
  /// Such a search that is rarely exceeded, s: the longest of the uniform model; by receiver
  /// state, that of a warm start as soon as one is possible, else of a hot one.
  [[nodiscard]] double long_search_s(double unseen_s) const;
  /// Probability that the ephemerides have expired after `unseen_s`: their remaining life at the last fix lies
  /// evenly between half of ephemeris_life_s and all of it.
  [[nodiscard]] double expired_probability(double unseen_s) const;
  /// A search by receiver state lies evenly within this share of its mean.
  static constexpr double kSearchSpread = 0.3;
  /// Excess of that factor over one.
  [[nodiscard]] static double excess_noise(int number);
};

/// Motor controller card. Resolutions are those of its status.
struct MotorModel : config::MotorAccuracy {
  double fin_resolution_deg = protocols::motor_card::kFinStep_deg;
  double current_resolution_A = protocols::motor_card::kCurrentStep_A;
  Timing timing = usual_timing(protocols::Protocol::motor_card, 19200);

  /// A reported fin angle: its noise with what rounding adds, rad.
  [[nodiscard]] double fin_report_noise_rad() const;
};

struct InstrumentModel {
  CompassModel compass;
  ImuModel imu;
  GpsModel gps;
  MotorModel motor;
};

/// The instruments as a configuration states them: the table [instruments], and of the port that serves each
/// instrument (named in [roles], else the first) its latency, rate, line speed, zeros, scales and mounting. What
/// no port states is the reference instrument's; an NMEA port that states no latency or rate states none.
[[nodiscard]] InstrumentModel instrument_model(const config::Settings& settings);

/// The same instruments without noise and turn-on bias; resolution, lag and timing stay.
[[nodiscard]] InstrumentModel without_noise(InstrumentModel model);

/// The same instruments at the origin, with the axes of the body: as samples are that the pipeline has turned.
[[nodiscard]] InstrumentModel without_mounting(InstrumentModel model);

/// Standard deviation of a reading with white noise that is rounded to a resolution: rounding adds the variance
/// resolution^2/12 (Widrow, Kollar and Liu, IEEE Trans. Instrumentation and Measurement 45, 1996). Any unit.
[[nodiscard]] double rounded_noise(double noise, double resolution);

}  // namespace navcal::devices
