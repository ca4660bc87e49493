// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

#include "sim/effects/effect.h"

namespace navcal::gap {

/// Where an error enters: one component of an instrument's reading, or of a force on the vehicle.
enum class ErrorPlace : std::uint8_t {
  field_x,  ///< body axes, uT
  field_y,
  field_z,
  heading,    ///< the Earth's field turned about the vertical, rad
  tilt_roll,  ///< rad
  tilt_pitch,
  gyro_ax,  ///< rad/s
  gyro_az,
  gyro_by,
  gyro_bz,
  force_x,  ///< accelerometers, m/s2
  force_y,
  force_z,
  depth,           ///< m
  position_north,  ///< of a fix, m
  position_east,
  velocity_north,  ///< of a fix, m/s
  velocity_east,
  current_north,  ///< of the water, m/s
  current_east,
  thrust,    ///< share of the propeller's force
  rudder,    ///< moment about z, as an angle of the fins, rad
  elevator,  ///< moment about y, as an angle of the fins, rad
  ailerons,  ///< moment about x, as an angle of the fins, rad
  heave,     ///< force upward, N
};

/// One component of a source.
struct ErrorComponent {
  std::string_view name;  ///< "x"
  ErrorPlace place;
  double typical;            ///< in the unit of the place
  std::string_view channel;  ///< of the answer (replay/reported_channels.h); empty: no channel belongs to it
  std::string_view unit;     ///< as people read it
  double per_si = 1;         ///< from the unit of the place to that one
};

/// An instrument or a force whose error a gap may be.
struct ErrorSource {
  std::string_view name;   ///< "compass.field"
  std::string_view words;  ///< "the compass's magnetic field"
  std::span<const ErrorComponent> components;
  bool follows_heading = false;  ///< whether its error may depend on the heading
  bool is_biased = false;        ///< whether its constant error is a nuisance: turn-on biases
  bool follows_orders = false;   ///< whether its error may depend on what the fins do
};
[[nodiscard]] std::span<const ErrorSource> error_sources();

inline constexpr sim::EffectDescription kTimedError =
    sim::described("timed_error", "reading += a s(t)", {{"amplitude", 1}}, "the one in which s(t) varies most");

/// An error that follows a time series: amplitude times series. Between two of its values it is interpolated,
/// outside it keeps the first or last.
class TimedError final : public sim::EffectOf<TimedError, kTimedError> {
 public:
  /// `begin_s`: mission time of the first value; they are kInterval_s apart. `series` is not empty.
  TimedError(ErrorPlace place, std::shared_ptr<const Eigen::VectorXd> series, double begin_s);

  void earth_field(const sim::Instant& now, sim::Vector3& field_world_uT) override;
  void body_field(const sim::Instant& now, sim::Vector3& field_body_uT) override;
  void tilt_said(const sim::Instant& now, sim::Tilt& tilt) override;
  void gyros(const sim::Instant& now, sim::GyroRates& rate_rad_s) override;
  void accelerometers(const sim::Instant& now, sim::Vector3& force_m_s2) override;
  void depth(const sim::Instant& now, double& depth_m) override;
  void antenna(const sim::Instant& now, sim::AntennaMotion& motion) override;
  void influence(double time_s, sim::Influences& on) override;
  void link_fins(double time_s, double step_s, sim::Vector3& fins_rad) override;

 private:
  [[nodiscard]] double at(double time_s) const;
  /// Index of the component among the places from `first` on. Places before it give a number that is too large to
  /// be one.
  [[nodiscard]] std::size_t index_from(ErrorPlace first) const {
    return static_cast<std::size_t>(place_) - static_cast<std::size_t>(first);
  }

  ErrorPlace place_;
  std::shared_ptr<const Eigen::VectorXd> series_;
  double begin_s_;
};

}  // namespace navcal::gap
