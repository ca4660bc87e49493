// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace navcal::nav {

struct Pose {
  std::int64_t time_ns = 0;
  double roll_rad = 0, pitch_rad = 0, heading_rad = 0;
  Eigen::Vector2d reckoned_m = Eigen::Vector2d::Zero();  ///< DeadReckoning's track, without its corrections
};

/// Estimates of the last seconds. A late reading is compared with the estimate for the time of its measurement.
/// The memory is bounded: entries are at least 40 ms apart, so 128 of them span five seconds.
class PastPoses {
 public:
  static constexpr std::size_t kCapacity = 128;
  static constexpr std::int64_t kSpacing_ns = 40'000'000;
  /// So far beyond the newest one a pose is extrapolated.
  static constexpr std::int64_t kReach_ns = 200'000'000;

  /// Later than all before.
  void push(const Pose& pose);
  /// The angles of all poses were wrong by this; angles in radians.
  void correct(const Eigen::Vector3d& roll_pitch_heading_rad) { corrected_rad_ += roll_pitch_heading_rad; }
  void clear() { count_ = 0; }
  /// Linear between neighbours; nullopt when it is too long ago or not yet.
  [[nodiscard]] std::optional<Pose> at(std::int64_t time_ns) const;

 private:
  [[nodiscard]] const Pose& entry(std::size_t i) const { return poses_[(first_ + i) % kCapacity]; }
  [[nodiscard]] Pose& entry(std::size_t i) { return poses_[(first_ + i) % kCapacity]; }

  [[nodiscard]] Pose corrected(Pose pose) const;

  std::array<Pose, kCapacity> poses_{};                      ///< each less the corrections of before it
  Eigen::Vector3d corrected_rad_ = Eigen::Vector3d::Zero();  ///< a compass corrects often: not pose by pose
  std::size_t first_ = 0, count_ = 0;
};

}  // namespace navcal::nav
