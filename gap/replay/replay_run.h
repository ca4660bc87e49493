// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

#include "gap/actuators/actuator_track.h"
#include "gap/replay/predicted_instruments.h"
#include "gap/replay/replay.h"
#include "gap/replay/state_history.h"

namespace navcal::gap {

/// Input of a run, from the replay that it belongs to.
struct ReplayInput {
  const Mission& mission;
  const config::VehicleSettings& settings;
  const sim::LayoutVehicle& vehicle;
  std::span<const ActuatorTrack::Row> actuators;
  std::span<const double> current_A;      ///< at the times of `actuators`
  std::span<const double> electronics_C;  ///< at each compass reading
  double begin_s = 0, compass_shift_s = 0;
  Eigen::Index intervals = 0;
  double longest_part_s = 0;  ///< longest integration step of the vehicle model
};

/// One replay with one model. Used once.
class ReplayRun {
 public:
  ReplayRun(const ReplayInput& input, const Model& model);
  ReplayRun(const ReplayRun&) = delete;
  ReplayRun& operator=(const ReplayRun&) = delete;

  [[nodiscard]] Innovations innovations(Trajectory10Hz* course);

 private:
  void begin(const CardReading& reading);
  /// Roll, pitch and heading at the first frame: by the compass, else by accelerometers and course over ground.
  [[nodiscard]] Eigen::Vector3d first_attitude(const CardReading& reading) const;
  void carry(const CardReading& to);
  void step(double from_s, double until_s, const Vector3& gyro_rad_s);
  void complete(sim::State& state, double time_s);
  void take_card(const CardReading& reading);
  void take_words(double until_s);
  /// Corrects roll and pitch by the accelerometers, in the place of an inclinometer that is silent.
  void level_by(const CardReading& reading, const PredictedInstruments::Card& said);
  void take_word(const CompassReading& reading, const sim::State& state);
  void take_fixes(double until_s);
  void take_fix(std::size_t index);
  /// Corrects the heading by the course over ground, in the place of a compass that is silent. `missed_m_s`: the
  /// velocity over ground less the predicted one, north and east. Whether it was set anew, so that this fix is no
  /// measurement.
  bool steer_by(const FixReading& fix, const std::array<double, 2>& missed_m_s, double degraded);
  void write_course(const CardReading& reading, Trajectory10Hz& course) const;
  /// Row of the grid; none before the first and after the last.
  [[nodiscard]] std::optional<Eigen::Index> interval_of(double time_s) const;
  void add(std::optional<Eigen::Index> interval, Channel channel, double innovation);

  ReplayInput in_;
  sim::EffectSet effects_;
  LinkedActuators actuators_;
  PredictedInstruments instruments_;
  Vector3 gyro_error_at_rest_rad_s_;
  sim::Influences influences_;
  sim::Body body_;              ///< the estimate
  Vector3 gyro_error_rad_s_{};  ///< predicted error of the rates about x, y, z
  Vector3 gyro_said_rad_s_{};   ///< at the last frame
  StateHistory states_;
  std::size_t next_word_ = 0, next_fix_ = 0;
  std::array<double, 2> offset_m_{};  ///< shift of the estimated position by the fixes
  double variance_m2_ = 0;
  std::optional<double> last_fix_s_;
  bool has_heading_ = true;  ///< else the heading is arbitrary until the course over ground shows it
  double distance_m_ = 0, distance_at_fix_m_ = 0;
  Innovations out_;
  // Each interval and channel is the mean of its readings: sums and counts.
  Eigen::Matrix<double, Eigen::Dynamic, kChannels, Eigen::RowMajor> sums_;
  Eigen::Matrix<int, Eigen::Dynamic, kChannels, Eigen::RowMajor> counts_;
};

}  // namespace navcal::gap
