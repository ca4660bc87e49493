// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "protocols/pd0.h"
#include "sim/instruments/altimeter.h"
#include "sim/instruments/device.h"
#include "sim/noise.h"
#include "sim/state.h"

namespace navcal::sim {

/// One ping of a Doppler log with four beams, at the origin of the vehicle, beam 3 forward.
struct DopplerPing {
  std::int64_t measured_ns = 0;
  State state;
  std::uint32_t number = 0;  ///< 1 for the first since power-on
  /// Along each beam; absent where the bottom is beyond the range, or the echo was lost. Velocities of the bottom,
  /// positive towards the head.
  std::array<std::optional<double>, 4> range_m{}, velocity_m_s{};

  [[nodiscard]] bool has_lock() const;  ///< all four beams
};

struct DopplerOptions {
  SeaFloor floor;
  double rate_Hz = 5;
  double latency_s = 0.1;  ///< from the reflection at the bottom to the first byte
  double beam_angle_rad = 0.5235987755982988;
  double beam_noise_m_s = 0.003;
  double scale_error = 0.002;  ///< velocities come out larger by this share
  double range_noise_m = 0.02;
  double range_m = 50, least_range_m = 0.2;  ///< along a beam
  double lost = 0;                           ///< probability that a beam loses its echo
  double clock_ppm = 0;
  std::uint64_t seed = 1;
  int baud = 115200;
};

/// What Doppler logs of any maker have in common: pings at the pace of their own clock, beams with noise and an
/// error of scale, bottom lock within the range only. A derived class encodes the pings. It hears nothing.
class DopplerLog : public MeasuringDevice<DopplerOptions> {
 public:
  using MeasuringDevice::MeasuringDevice;

  void power_on(std::int64_t t_ns) override;

 protected:
  /// All bytes of one ping, sent at `sent_ns`.
  [[nodiscard]] virtual std::vector<std::uint8_t> encode(const DopplerPing& ping, std::int64_t sent_ns) const = 0;

 private:
  void act(std::int64_t now_ns, std::vector<Emission>& out) override;
  [[nodiscard]] DopplerPing measure(std::int64_t t_ns);

  std::uint32_t pings_ = 0;
};

/// Velocity of the vehicle over the bottom, body axes, without errors: through the water, and the current's.
[[nodiscard]] Vector3 velocity_over_bottom_m_s(const State& state);
/// Velocity of the vehicle by the beams of a ping with lock: forward, starboard, down; `error` is the error
/// velocity.
struct DopplerSolution {
  Vector3 body_m_s{};
  double error_m_s = 0;
};
[[nodiscard]] DopplerSolution solved(const DopplerPing& ping, double beam_angle_rad);
/// Heading clockwise from magnetic north, 0 to 2 pi.
[[nodiscard]] double magnetic_heading_rad(const State& state);

/// Teledyne log that sends PD0, with its own compass, inclinometer and pressure gauge.
class Pd0Doppler final : public DopplerLog {
 public:
  struct Options : DopplerLog::Options {
    protocols::pd0::Axes axes = protocols::pd0::Axes::instrument;
    bool uses_tilts = true;  ///< velocities in the ship's axes are made level
    bool convex = true;
  };
  Pd0Doppler(const Options& options, const Motion& motion) : DopplerLog(options, motion), sent_as_(options) {}

 protected:
  [[nodiscard]] std::vector<std::uint8_t> encode(const DopplerPing& ping, std::int64_t sent_ns) const override;

 private:
  [[nodiscard]] std::array<std::optional<double>, 4> velocities_m_s(const DopplerPing& ping) const;

  Options sent_as_;
};

/// Teledyne log that sends PD6, with its own compass and inclinometer.
class Pd6Doppler final : public DopplerLog {
 public:
  using DopplerLog::DopplerLog;

 protected:
  [[nodiscard]] std::vector<std::uint8_t> encode(const DopplerPing& ping, std::int64_t sent_ns) const override;
};

/// Water Linked log with lines wrz, and wru for each beam.
class WaterLinkedDoppler final : public DopplerLog {
 public:
  using DopplerLog::DopplerLog;

 protected:
  [[nodiscard]] std::vector<std::uint8_t> encode(const DopplerPing& ping, std::int64_t sent_ns) const override;
};

}  // namespace navcal::sim
