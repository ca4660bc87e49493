// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <variant>
#include <vector>

#include "nav/navigator.h"
#include "sim/path.h"

/// Readings that the instruments of a vehicle on a known path would give to the navigator.
namespace navcal::nav::test {

inline constexpr std::int64_t kSecond_ns = 1'000'000'000;
inline constexpr std::int64_t kStart_ns = 1'000 * kSecond_ns;
inline constexpr double kDegree = 0.017453292519943295;

using Reading = std::variant<RateReading, CompassReading, ShaftReading, FixReading, GroundVelocityReading,
                             WaterVelocityReading>;

struct DvlOptions {
  double period_s = 0.2, latency_s = 0.12;
  bool bottom = true, water = false;
  std::function<bool(double t_s)> locked = [](double) { return true; };
  double noise_m_s = 0.01;  ///< each axis; also what it states
  double scale = 1;         ///< read over true
  double yaw_rad = 0;       ///< of its axes from the body's, not known to the navigator
  VelocityFrame frame = VelocityFrame::body;
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  double bad_share = 0;  ///< of the measurements that are metres a second off
};

struct DriveOptions {
  bool rates = true, compass = true, shaft = true;
  std::function<bool(double t_s)> fixed = [](double) { return true; };  ///< whether there is a fix
  /// Compass output for a true heading, before noise.
  std::function<double(double heading_rad)> compass_says = [](double heading_rad) { return heading_rad; };
  Eigen::Vector3d zero_rad_s = Eigen::Vector3d::Zero();   ///< of the gyros
  Eigen::Vector2d current_m_s = Eigen::Vector2d::Zero();  ///< moves the position
  std::optional<DvlOptions> dvl;
  double advance_m = 0.0872;  ///< of the shaft
  double shaft_share = 1;     ///< read over true
  bool noise = true;          ///< of VEHICLE's usual instruments
  bool late = true;           ///< readings come as late as on the vehicle
  std::uint32_t seed = 1;
};

struct Arrived {
  std::int64_t arrival_ns = 0;
  Reading reading;
};

/// Readings from the beginning of the way to `duration_s`, in the order of their arrival.
[[nodiscard]] std::vector<Arrived> readings_along(const sim::Motion& motion, double duration_s,
                                                  const DriveOptions& options);
void give(Navigator& navigator, const Reading& reading);
/// Gives all of them, those up to `until_s` if said.
void give(Navigator& navigator, const std::vector<Arrived>& readings, double until_s = 1e9);

[[nodiscard]] inline double since_start_s(std::int64_t time_ns) {
  return static_cast<double>(time_ns - kStart_ns) * 1e-9;
}
/// Where the vehicle is over ground: the way, and the current since the start.
[[nodiscard]] Eigen::Vector2d true_position_m(const sim::Motion& motion, std::int64_t time_ns,
                                              const Eigen::Vector2d& current_m_s = Eigen::Vector2d::Zero());
/// Error of the estimate at its time.
[[nodiscard]] double position_error_m(const Navigator& navigator, const sim::Motion& motion,
                                      const Eigen::Vector2d& current_m_s = Eigen::Vector2d::Zero());
[[nodiscard]] double heading_error_rad(const Navigator& navigator, const sim::Motion& motion);

/// Level, ahead at this speed, with a rate of turn that depends on the time; the shaft turns as the advance asks.
[[nodiscard]] sim::PathMotion level_way(double duration_s, double speed_m_s,
                                        const std::function<double(double t_s)>& rate_rad_s, double depth_m = 0,
                                        double heading_rad = 0);
/// One of fixtures/paths.
[[nodiscard]] sim::PathMotion reference_way(const std::string& name);

}  // namespace navcal::nav::test
