// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "base/reference_instruments.h"
#include "calib/archive.h"

namespace navcal::calib {

/// Roll and pitch of a vehicle whose inclinometer lags, by an extended Kalman filter and its fixed-lag smoother
/// (Rauch, Tung and Striebel, AIAA Journal 3, 1965).
///
/// Model: state (roll, pitch, the two as the fluid shows them, biases and scale errors of the roll and pitch
/// gyros):
///   roll'  = p + tan(pitch) (q sin(roll) + r cos(roll)),   pitch' = q cos(roll) - r sin(roll)
///   shown' = (tilt - shown) / lag,   rate = (1 + scale) measured + bias
/// The inclinometer reads `shown` with white noise. The biases walk; the scale errors are constant. The gyros
/// carry the tilt over the lag, the inclinometer holds it in the long run. Radians, seconds, body axes.
class TiltSmoother {
 public:
  struct Parameters {
    double lag_s = base::reference::kTiltLag_s;  ///< of the inclinometer, first order; positive
    double tilt_noise_rad = base::reference::kReckonedTiltNoise_rad;  ///< of one reading
    double rate_noise_rad_sqrt_s = 0.0004;  ///< density: of a reading times the root of its period
    double bias_std_rad_s = 0.0175;         ///< before the first reading; 1 degree/s
    double bias_walk_rad_s_sqrt_s = 3.5e-4;
    double scale_std = 0.02;
  };
  static constexpr std::uint32_t kCapacity = 40;

  enum Index : int { kRoll, kPitch, kShownRoll, kShownPitch, kBiasX, kBiasY, kScaleX, kScaleY, kStates };
  using State = Eigen::Matrix<double, kStates, 1>;

  explicit TiltSmoother(const Parameters& parameters);

  /// Restarts the tilt with a reading (roll, pitch) and its slope. The knowledge of the gyros is kept.
  void start(const Eigen::Vector2d& shown_rad, const Eigen::Vector2d& slope_rad_s);
  /// Carried on by the mean rates (p, q as measured; r as it is) over `duration_s`.
  void predict(const Eigen::Vector3d& rate_rad_s, double duration_s);
  /// A reading of the inclinometer. There must be room: size() below kCapacity.
  void correct(const Eigen::Vector2d& shown_rad);

  /// Readings held.
  [[nodiscard]] std::uint32_t size() const { return count_; }
  /// The state at the oldest reading held, by all readings held and before.
  [[nodiscard]] State oldest() const;
  void drop_oldest();
  void clear() { count_ = 0; }

  /// Slopes of roll and pitch by the gyros.
  [[nodiscard]] static Eigen::Vector2d slope_rad_s(const State& state, const Eigen::Vector3d& rate_rad_s);

  void archive(Archive& archive);

 private:
  using Covariance = Eigen::Matrix<double, kStates, kStates>;
  /// A reading: the state by it and all before, what it changed, and the smoother's gain on what the next changes.
  struct Node {
    State filtered = State::Zero(), change = State::Zero();
    Covariance gain = Covariance::Zero();
    void archive(Archive& archive) { archive(filtered, change, gain); }
  };
  [[nodiscard]] Node& node(std::uint32_t i) { return nodes_[(first_ + i) % kCapacity]; }
  [[nodiscard]] const Node& node(std::uint32_t i) const { return nodes_[(first_ + i) % kCapacity]; }

  Parameters parameters_;
  State state_ = State::Zero();
  Covariance covariance_ = Covariance::Zero();
  Covariance since_ = Covariance::Zero();  ///< covariance of the state with that at the newest reading
  std::array<Node, kCapacity> nodes_{};    ///< ring
  std::uint32_t first_ = 0, count_ = 0;
};

}  // namespace navcal::calib
