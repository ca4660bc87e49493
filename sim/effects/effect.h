// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>
#include <memory>
#include <span>

#include "sim/effects/description.h"
#include "sim/rotation.h"
#include "sim/state.h"
#include "sim/vehicle/influences.h"

namespace navcal::sim {

/// Input of an effect at one instant. It contains nothing measured, so the diagnosis can differentiate an
/// effect at predicted, noise-free values.
struct Instant {
  double time_s = 0;  ///< since the beginning of the mission
  const State& state;
  double electronics_C = base::reference::kTemperature_C;  ///< temperature of the electronics

  /// Temperature of the electronics above the reference of the temperature coefficients.
  [[nodiscard]] double temperature_rise_C() const { return electronics_C - base::reference::kTemperature_C; }
  /// Acceleration of the body's origin relative to the world, in body axes: the specific force plus gravity.
  [[nodiscard]] Vector3 acceleration_m_s2() const {
    const Vector3 gravity = transpose(R_world_from_body(state.euler_rad)) * Vector3{0, 0, kGravity_m_s2};
    Vector3 result = state.specific_force_m_s2;
    for (std::size_t i = 0; i < 3; ++i) result[i] += gravity[i];
    return result;
  }
};

/// Tilt that the inclinometer senses or reports.
struct Tilt {
  double roll_rad = 0, pitch_rad = 0;
};

/// Gyro rates of the inertial card, in the order of its channels: A-x, A-z, B-y, B-z.
using GyroRates = std::array<double, 4>;
/// Body axis that each of these gyros senses.
inline constexpr std::array<std::size_t, 4> kGyroAxes{0, 2, 1, 2};

/// All channels of the inertial card as its converter sees them.
using CardVoltages_mV = std::array<double, 8>;

/// Motion of the GPS antenna, in world axes.
struct AntennaMotion {
  Vector3 position_m{};
  Vector3 velocity_m_s{};
};

/// Extra age of an instrument's data relative to their time, beyond its nominal latency.
struct Delays {
  double card_s = 0;
  double gps_s = 0;
};

enum class Instrument : std::uint8_t { compass, imu, gps, motor };
inline constexpr std::size_t kInstruments = 4;

/// Transmission of a frame over its line.
struct Transmission {
  int copies = 1;           ///< 0: it is lost
  double late_s = 0;        ///< the host takes it so much later
  double held_until_s = 0;  ///< the host takes nothing before this time of the mission
};

/// One departure from the nominal model, by a few parameters. Each hook is called in order of its own instrument's
/// time and changes what it is handed; those that are not overridden change nothing. The result depends only on
/// the arguments, the parameters and the effect's own filter or noise: the simulator and the diagnosis, which
/// differentiates by the parameters, use the same code.
class Effect {
 public:
  virtual ~Effect() = default;
  [[nodiscard]] virtual const EffectDescription& description() const = 0;
  /// Copies the effect with the state of its filters.
  [[nodiscard]] virtual std::unique_ptr<Effect> clone() const = 0;
  [[nodiscard]] virtual std::span<const double> parameters() const = 0;
  /// Sets the parameters: as many as described, in that order, in the units of their names.
  virtual void set_parameters(std::span<const double> values) = 0;
  /// Seeds the effect's own random numbers.
  virtual void reseed(std::uint64_t /*seed*/) {}

  // Compass: the Earth's field, the body's field, the tilt that drives the inclinometer's fluid, the tilt it
  // reports.
  virtual void earth_field(const Instant&, Vector3& /*field_world_uT*/) {}
  virtual void body_field(const Instant&, Vector3& /*field_body_uT*/) {}
  virtual void tilt_seen(const Instant&, Tilt&) {}
  virtual void tilt_said(const Instant&, Tilt&) {}
  // Inertial card.
  virtual void gyros(const Instant&, GyroRates& /*rate_rad_s*/) {}
  virtual void accelerometers(const Instant&, Vector3& /*force_m_s2*/) {}
  virtual void depth(const Instant&, double& /*depth_m*/) {}
  virtual void card_voltages(const Instant&, CardVoltages_mV&) {}
  // Receiver.
  virtual void antenna(const Instant&, AntennaMotion&) {}
  virtual void delays(Delays&) {}
  // Vehicle (sim/vehicle/influences.h).
  virtual void influence(double /*time_s*/, Influences&) {}
  virtual void link_fins(double /*time_s*/, double /*step_s*/, Vector3& /*fins_rad*/) {}
  // Noise, clocks and lines.
  virtual void noise(Instrument, double& /*factor*/) {}
  virtual void clock(Instrument, double& /*slow_ppm*/) {}
  virtual void line(Instrument, double /*time_s*/, Transmission&) {}
};

/// An effect as `kAbout` describes it; `Self` is the class derived from it.
template <class Self, const EffectDescription& kAbout>
class EffectOf : public Effect {
 public:
  static constexpr std::string_view kName = kAbout.name;
  [[nodiscard]] const EffectDescription& description() const final { return kAbout; }
  [[nodiscard]] std::unique_ptr<Effect> clone() const final {
    return std::make_unique<Self>(static_cast<const Self&>(*this));
  }
  [[nodiscard]] std::span<const double> parameters() const final { return p_; }
  void set_parameters(std::span<const double> values) final {
    assert(values.size() == p_.size());
    std::copy_n(values.begin(), p_.size(), p_.begin());
  }

 protected:
  [[nodiscard]] Vector3 vector(std::size_t first = 0) const { return {p_[first], p_[first + 1], p_[first + 2]}; }

  std::array<double, kAbout.parameters.size()> p_{};
};

/// to += factor * vector.
inline void add_scaled(Vector3& to, double factor, const Vector3& vector) {
  for (std::size_t i = 0; i < 3; ++i) to[i] += factor * vector[i];
}

}  // namespace navcal::sim
