// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <span>

#include "identify/data/actuator_inputs.h"
#include "identify/data/channel.h"
#include "identify/replay/predicted_readings.h"
#include "sim/layout/layout_vehicle.h"
#include "sim/vehicle/body.h"

namespace navcal::identify {

/// State of the filter: StateVector, then the six accelerations of the disturbance d in body axes. SI. Here the
/// position is in the world: it contains what the water carries.
inline constexpr Eigen::Index kFilterStates = kStates + 6;
inline constexpr Eigen::Index kTilt = 12;  ///< of roll, as the tilt sensor feels it; pitch follows
using FilterState = Eigen::Matrix<double, kFilterStates, 1>;
using FilterMatrix = Eigen::Matrix<double, kFilterStates, kFilterStates>;

/// Derivatives of a step's end by the Euler angles and velocities at its begin. The rest of the transition matrix
/// follows from them: Transition.
using StepDerivatives = Eigen::Matrix<double, kStates, 9>;

/// A vehicle under its recorded actuators, disturbed by accelerations, and its instruments.
class FilterModel {
 public:
  /// `vehicle` and `recorded` must outlive it.
  FilterModel(const sim::LayoutVehicle& vehicle, std::shared_ptr<const ActuatorTrajectory> actuators,
              const RecordedMotion& recorded, const Calibration& calibration, InstrumentErrors errors = {});

  /// Actuators at a step's begin, middle and end. Simpson's mean of them is that of the step: what the middle is
  /// not where a command jumps.
  struct Moved {
    sim::LayoutVehicle::Held begin, middle, end;
  };
  [[nodiscard]] Moved moved_over(double time_s, double step_s) const;
  /// The state a step later. d acts as a change of velocity, half before and half behind the Runge-Kutta step, and
  /// decays with tau.
  [[nodiscard]] FilterState after(const FilterState& state, const Moved& moved, double step_s, double tau_s) const;
  /// About `state`, whose end is `end`, by differences over its standard errors `stds`.
  [[nodiscard]] StepDerivatives derivatives(const FilterState& state, const FilterState& stds,
                                            const FilterState& end, const Moved& moved, double step_s,
                                            double tau_s) const;
  /// nu' over a step without the disturbance: its mean by Simpson's rule, what it falls by, and its end.
  struct Acceleration {
    sim::Vector6 mean, fall, end;
  };
  /// `begin`: nu' at the begin; nullptr: computed.
  [[nodiscard]] Acceleration acceleration_over(const FilterState& from, const FilterState& to, double time_s,
                                               double step_s, const sim::Vector6* begin) const;
  /// Tilt at the end of a step beyond that of `other`, as far as their tilt sensors' fluids feel another tilt over
  /// it.
  [[nodiscard]] Eigen::Vector2d tilt_beyond(const FilterModel& other, const FilterState& from,
                                            const FilterState& to, const Acceleration& over, double step_s) const;
  /// Whether the same vehicle is under the same actuators at the same times.
  [[nodiscard]] bool is_driven_as(const FilterModel& other) const;
  /// Whether a channel's readings depend on the acceleration: an accelerometer's, and all that are late.
  [[nodiscard]] bool feels_forces(Channel channel) const;
  [[nodiscard]] bool feels_tilt_as(const FilterModel& other) const { return errors_.feels_tilt_as(other.errors_); }
  [[nodiscard]] Eigen::Vector3d current() const { return current_of(calibration_); }
  /// Whether no instrument's readings are late.
  [[nodiscard]] bool is_prompt() const;
  /// Readings less predictions at one instant, angles wrapped, to `out`. `acceleration`: nu' without the
  /// disturbance where it is known and is_prompt(), or nullptr.
  void innovations(const FilterState& state, double time_s, std::span<const ChannelReading> readings, double* out,
                   const sim::Vector6* acceleration = nullptr) const;
  /// Derivatives of the predictions by the state in the same way, one column for each reading.
  void sensitivities(const FilterState& state, const FilterState& stds, double time_s,
                     std::span<const ChannelReading> readings, std::span<FilterState> out) const;

 private:
  void predict(const FilterState& state, const sim::LayoutVehicle::Held* held,
               std::span<const ChannelReading> readings, double* out) const;
  void predict(const MotionPoint& now, const FilterState& state, const sim::LayoutVehicle::Held* held,
               std::span<const ChannelReading> readings, double* out) const;
  /// Begin, middle and end of a step.
  [[nodiscard]] std::array<sim::ActuatorValues, 3> actuators_over(double time_s, double step_s) const;
  [[nodiscard]] double age_of(Channel channel) const;
  /// The motion so long before, as far as velocities and acceleration tell it.
  [[nodiscard]] MotionPoint before(MotionPoint point, double age_s) const;
  /// Actuators where a reading depends on the acceleration, else none: those that an accelerometer felt.
  [[nodiscard]] std::unique_ptr<const sim::LayoutVehicle::Held> held_for(std::span<const ChannelReading> readings,
                                                                         double time_s) const;

  const sim::LayoutVehicle& vehicle_;
  std::shared_ptr<const ActuatorTrajectory> actuators_;
  Calibration calibration_;
  InstrumentErrors errors_;
  PredictedReadings instruments_;
  double tilt_lag_s_;
};

/// Transition matrix F of a step by its blocks: a third of its elements are not zero.
class Transition {
 public:
  /// `derivatives` must outlive it.
  Transition(const StepDerivatives& derivatives, double tilt_lag_s, double step_s, double tau_s);

  /// F x.
  [[nodiscard]] FilterState operator*(const FilterState& x) const;
  /// F C F^T of a covariance C.
  [[nodiscard]] FilterMatrix on_both_sides_of(const FilterMatrix& covariance) const;

 private:
  const StepDerivatives& derivatives_;
  double half_step_s_, tilt_left_, disturbance_left_;
};

/// Sizes of what disturbs a vehicle, axis by axis (surge, sway, heave, roll, pitch, yaw), and of its instruments'
/// noise.
struct FilterNoises {
  /// Random walk of the velocity: m/s and rad/s per root of a second.
  sim::Vector6 white = (sim::Vector6() << 0.01, 0.01, 0.01, 0.02, 0.02, 0.02).finished();
  /// Standard deviation of the coloured disturbance d, m/s2 and rad/s2: d' = -d/tau + white noise.
  sim::Vector6 coloured = sim::Vector6::Constant(0.1);
  double tau_s = 3;
  /// Noise of a channel's readings over the stated one.
  std::array<double, kChannels> factor = filled(1);

 private:
  static constexpr std::array<double, kChannels> filled(double with) {
    std::array<double, kChannels> all{};
    for (double& one : all) one = with;
    return all;
  }
};

}  // namespace navcal::identify
