// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <map>
#include <memory>
#include <string_view>
#include <vector>

#include "identify/replay/motion_point.h"
#include "sim/effects/effect_set.h"

namespace navcal::identify {

/// Errors of instruments as effects of the simulator have them (sim/effects/library). Each reading's
/// error follows from the motion at its instant: effects with a memory, or of time stamps, are none of these.
class InstrumentErrors {
 public:
  /// None.
  InstrumentErrors() = default;
  /// Effects by name, each with its first parameters in the units of their names; the others are zero.
  explicit InstrumentErrors(const std::map<std::string_view, std::vector<double>>& parameters);

  [[nodiscard]] bool empty() const { return effects_ == nullptr; }
  /// Whether felt_tilt() can be other than zero, and other than that of other errors.
  [[nodiscard]] bool has_felt_tilt() const { return !usual_tilt_.isZero(0); }
  [[nodiscard]] bool feels_tilt_as(const InstrumentErrors& other) const {
    return usual_tilt_ == other.usual_tilt_;
  }
  /// Errors of the gyros of roll, pitch and yaw and of the second yaw gyro, rad/s. `force_m_s2`: specific force
  /// where they are.
  [[nodiscard]] std::array<double, 4> of_rates(const sim::Body& body, const Eigen::Vector3d& force_m_s2) const;
  /// The field in the body as the magnetometers show it.
  [[nodiscard]] Eigen::Vector3d shown_field(const Eigen::Vector3d& field_uT) const;
  /// Roll and pitch that a tilt sensor's fluid feels beyond those of the body, whose nu' is `acceleration`.
  [[nodiscard]] Eigen::Vector2d felt_tilt(const sim::Body& body, const sim::Vector6& acceleration) const;

 private:
  std::shared_ptr<sim::EffectSet> effects_;               ///< their hooks change nothing but what they are given
  Eigen::Vector2d usual_tilt_ = Eigen::Vector2d::Zero();  ///< felt at rest with a usual acceleration
};

/// Direction of the Earth's field in the body, yaw counted from magnetic north.
[[nodiscard]] Eigen::Vector3d field_in_body(const Eigen::Vector3d& euler_rad, double dip_rad);
/// Heading of a compass that levels its field by a tilt of its own.
[[nodiscard]] double levelled_heading(const Eigen::Vector3d& field, const Eigen::Vector2d& tilt_rad);
/// Specific force at a place in the body; `down`: of the world, in the body.
[[nodiscard]] Eigen::Vector3d specific_force(const MotionPoint& point, const Eigen::Vector3d& down,
                                             const Eigen::Vector3d& place_m);

}  // namespace navcal::identify
