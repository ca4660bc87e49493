// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "autopilot/mission_orders.h"
#include "base/local_plane.h"

namespace navcal::autopilot {

/// The vehicle's state as the daemon reports it (class STATE of docs/status-protocol.md). SI units and radians;
/// what is not known is absent.
struct Reading {
  std::optional<double> heading_rad;  ///< wrapped
  std::optional<double> pitch_rad;
  std::optional<double> roll_rad;
  std::optional<Eigen::Vector3d> rate_rad_s;  ///< body rates p, q, r
  std::optional<double> depth_m;
  std::optional<double> altitude_m;  ///< above the sea floor
  std::optional<double> latitude_rad, longitude_rad;
  std::optional<double> speed_m_s;
  // Age of the newest reading of each instrument; absent: there was none.
  std::optional<double> compass_age_s, imu_age_s, motor_age_s;
  std::vector<std::string>
      alarms;  ///< "leak forward", "leak aft", "over range", "low supply", "battery low", "floor near"
};

/// Limits whose violation ends a mission early.
struct PilotLimits {
  double depth_m = 10;
  double altitude_m = 0;  ///< least height above the sea floor; 0: not watched
  double duration_s = 3600;
  double range_m = 1000;  ///< from where the mission began
  double age_s = 1;       ///< of the newest readings of compass, inertial card and motor card
};

/// Takes a vehicle through a mission, once, by what the daemon reports; no sockets, no clock. A reading comes,
/// orders go out. Anything that ends the mission also stops the vehicle: shaft off, and for kRise_s the fins that
/// raise the nose while the vehicle is deeper than kSurface_m, so that it uses its way to come up; then fins
/// neutral.
class Pilot {
 public:
  static constexpr double kRise_s = 5;
  static constexpr double kSurface_m = 0.3;
  static constexpr double kSurface_s = 1;

  Pilot(const config::VehicleSettings& vehicle, const config::Mission& mission, const PilotLimits& limits);

  /// Why a mission cannot begin with this reading, one reason each; empty: it can.
  [[nodiscard]] std::vector<std::string> missing(const Reading& reading) const;
  /// Orders for a reading that came at `now_s`, of a clock that never goes back. The first call begins the
  /// mission.
  [[nodiscard]] Orders next(const Reading& reading, double now_s);
  /// Stops the vehicle from now on. The first reason is kept. nullopt: the mission is done.
  void stop(std::optional<std::string> reason, double now_s);

  [[nodiscard]] bool stopping() const { return stopped_at_s_.has_value(); }
  /// The vehicle has been ordered to stop for long enough: kRise_s, or kSurface_s at the surface. It can be let
  /// go.
  [[nodiscard]] bool stopped(double now_s) const;
  /// Why it is stopping; nullopt: the mission is done.
  [[nodiscard]] const std::optional<std::string>& reason() const { return reason_; }
  [[nodiscard]] const MissionOrders& mission() const { return mission_; }
  [[nodiscard]] double elapsed_s(double now_s) const { return began_s_ ? now_s - *began_s_ : 0; }

 private:
  /// The limit that is exceeded, the device that is silent, or the fault of the vehicle; nullopt when there is
  /// none.
  [[nodiscard]] std::optional<std::string> alarm(const Reading& reading, double now_s) const;
  void take(const Reading& reading, double period_s);
  [[nodiscard]] Orders stopping_orders(const Reading& reading, double now_s, double period_s);
  [[nodiscard]] bool can_steer(const Reading& reading) const;

  config::VehicleSettings vehicle_;
  PilotLimits limits_;
  MissionOrders mission_;
  Autopilot to_surface_;
  VehicleState state_;
  std::optional<double> began_s_, last_s_, stopped_at_s_;
  double stopped_heading_rad_ = 0;
  std::optional<std::string> reason_;
  /// Way by speed and heading since the beginning: north, east.
  std::array<double, 2> reckoned_m_{};
  std::optional<base::LocalPlane> plane_;     ///< about the first position that is known
  std::array<double, 2> first_reckoned_m_{};  ///< reckoned there
  std::array<double, 2> offset_m_{};          ///< position of the vehicle relative to the beginning
};

}  // namespace navcal::autopilot
