// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "validation/reference/hull.h"
#include "validation/reference/parameter_deviations.h"
#include "validation/reference/rng.h"
#include "validation/reference/snapshot.h"
#include "validation/reference/thrusters/drag.h"
#include "validation/reference/thrusters/rotor.h"
#include "validation/reference/vehicle.h"

namespace navcal::reference::thrusters {

/// The water around a vehicle: a current that changes slowly, a swell of one period, the local gravity. North,
/// east, down.
class Sea {
 public:
  /// Still, with the gravity of kGravity_m_s2.
  Sea() = default;
  /// By the dice: phases, periods and direction. Amplitudes in m/s and m.
  Sea(double latitude_rad, double current_m_s, double wave_m, Rng& dice);

  void set_current(const Eigen::Vector2d& steady_m_s) { steady_m_s_ = steady_m_s; }
  void add_wave(double amplitude_m) { wave_m_ += amplitude_m; }

  /// Its acceleration is neglected: below 1e-4 m/s2.
  [[nodiscard]] Eigen::Vector2d current_m_s(double time_s) const;
  /// Acceleration of the water by the swell, deep-water theory (Airy), m/s2.
  [[nodiscard]] Vector3 wave_acceleration_m_s2(const Vector3& position_m, double time_s) const;
  /// Height of the surface above the mean, m.
  [[nodiscard]] double surface_m(const Vector3& position_m, double time_s) const;
  [[nodiscard]] double gravity_m_s2() const { return gravity_m_s2_; }

 private:
  [[nodiscard]] double phase(const Vector3& position_m, double time_s) const;

  double gravity_m_s2_ = kGravity_m_s2;
  Eigen::Vector2d steady_m_s_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d swing_m_s_ = Eigen::Vector2d::Zero();
  double swing_rad_s_ = 0, swing_phase_ = 0;
  double wave_m_ = 0, wave_rad_s_ = 1.5, wave_phase_ = 0;
  Eigen::Vector2d wave_direction_{1, 0};
};

/// At the ellipsoid (WGS84, formula of Somigliana), m/s2.
[[nodiscard]] double gravity_at(double latitude_rad);

/// A vehicle with thrusters, by the spatial momentum h = (P, H) of body and carried water about the layout's
/// origin, body axes (Featherstone, Rigid Body Dynamics Algorithms, ch. 2; Lamb, Hydrodynamics, ch. 6):
///     h' = -v x* h + force:  P' = P x omega + F,  H' = H x omega + P x v + M,   (v, omega) = inverse(M) h
///     x' = R v + current,    q' = 1/2 q (0, omega),   two further states for each rotor (Rotor)
/// Integrated by the pair of Dormand and Prince with control of the error (Boost.Odeint), never across an order.
/// Weight acts at the centre of gravity, buoyancy at its own centre; what stands out of the water gives none.
class Craft {
 public:
  static constexpr double kStep_s = 0.005;
  static constexpr double kTolerance = 1e-8;  ///< of one step, absolute (SI) and relative

  Craft(const Plan& plan, const CraftDeviations& deviations, const Nature& nature, const Sea& sea,
        const Start& start, double tolerance = kTolerance);
  Craft(const Craft&) = delete;
  Craft& operator=(const Craft&) = delete;
  ~Craft();

  /// From now on: one command for each thruster, in its unit.
  void order(const std::vector<double>& commands);
  void advance(double to_s);

  [[nodiscard]] Snapshot snapshot() const;
  /// Kinetic energy of body and carried water, and potential energy of weight and buoyancy, of a vehicle that is
  /// wholly under water; constant without drive and drag.
  [[nodiscard]] double energy_J() const;
  /// Momenta about the origin, turned into the world's axes.
  [[nodiscard]] Vector6 momentum() const;
  [[nodiscard]] bool finite() const;
  [[nodiscard]] double time_s() const { return time_s_; }

 private:
  /// Position, quaternion (x, y, z, w), P, H; then s and w of each rotor.
  using State = std::vector<double>;
  struct Stepper;

  void slope(const State& y, State& dy, double time_s) const;
  [[nodiscard]] Flow flow_of(const State& y) const;
  [[nodiscard]] Wrench wrench(const State& y, const State& dy, double time_s, const Flow& flow) const;
  [[nodiscard]] Wrench still_wrench(const State& y, double time_s, const Flow& flow) const;
  [[nodiscard]] double sag(const State& y) const;
  void step(double to_s);

  Plan plan_;
  CraftDeviations deviations_;
  Sea sea_;
  Matrix6 inertia_, inverse_inertia_;
  Matrix6 displaced_;  ///< added mass with that of the displaced water: what a swell pulls at
  Drag drag_;
  Vector6 drag_factors_;
  std::vector<Rotor> rotors_;
  double time_s_ = 0, settled_s_ = 0;
  State y_;
  std::unique_ptr<Stepper> stepper_;
};

}  // namespace navcal::reference::thrusters
