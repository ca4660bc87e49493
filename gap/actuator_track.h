#pragma once

#include <span>
#include <vector>

#include "gap/mission.h"

namespace navcal::gap {

/// What the motor card's reports, ten a second with noise and resolution, say of the servos' shafts, the
/// propeller's and the current in between. A servo is a first-order lag behind a command that steps at times of
/// its own: where two reports are further apart than a steady command allows, the command and the instant of its
/// step are solved for from the report after; else the angle goes as the lag would take it from one report to the
/// next. A coarser picture of the fins shows as noise in everything that the vehicle does.
class ActuatorTrack {
 public:
  static constexpr double kStep_s = 0.01;

  struct Row {
    Vector3 fins_rad{};        ///< of the servos' shafts
    Vector3 clean_fins_rad{};  ///< the same without the reports' noise, and without what moves as little as that
    double shaft_rps = 0;
  };

  /// `servo_lag_s`: of the nominal servo. Readings in order of time, at least one.
  ActuatorTrack(std::span<const MotorReading> readings, double servo_lag_s, double duration_s);

  /// At k kStep_s, k = 0 ... covering the duration.
  [[nodiscard]] std::span<const Row> rows() const { return rows_; }
  /// Of the motor, amperes: `nominal_A` of the shaft speed, which has no noise, and the mean difference of the
  /// reports from that over some seconds. At the times of rows().
  [[nodiscard]] std::vector<double> current_A(std::span<const MotorReading> readings,
                                              std::span<const double> nominal_A) const;

 private:
  std::vector<Row> rows_;
};

}  // namespace navcal::gap
