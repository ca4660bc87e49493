// SPDX-License-Identifier: Apache-2.0
#include "identify/data/gridded.h"

#include <Eigen/Geometry>

#include "base/rotation.h"

namespace navcal::identify {
std::vector<double> on_grid(const RecordedMotion& motion, Channel channel, std::size_t rows) {
  std::vector<double> out(rows, kUnknown);
  const auto& readings = motion[channel];
  std::size_t next = 0;
  for (std::size_t k = 0; k < rows; ++k) {
    const double time_s = kGrid_s * static_cast<double>(k);
    while (next < readings.size() && readings[next].time_s < time_s) ++next;
    if (next == 0 || next == readings.size()) continue;
    const Reading &a = readings[next - 1], &b = readings[next];
    if (b.time_s - a.time_s > kGap_s) continue;
    const double change = describe(channel).is_angle ? base::wrapped(b.value - a.value) : b.value - a.value;
    out[k] = a.value + (time_s - a.time_s) / (b.time_s - a.time_s) * change;
  }
  return out;
}

double GriddedMotion::slope(Channel channel, std::size_t k) const {
  if (k < kSlopeSteps || k + kSlopeSteps >= rows) return kUnknown;
  return change(channel, k - kSlopeSteps, k + kSlopeSteps) / kSlope_s;
}

GriddedMotion::GriddedMotion(const RecordedMotion& motion, Channel doppler) : rows(grid_rows(motion)) {
  for (std::size_t c = 0; c < kChannels; ++c)
    if (!motion.channels[c].empty()) values[c] = on_grid(motion, static_cast<Channel>(c), rows);
  has_tilt = motion.has(Channel::roll) && motion.has(Channel::pitch);
  has_gyros = motion.has(Channel::rate_z);
  if (!motion.has(doppler)) doppler = doppler == Channel::bottom_x ? Channel::water_x : Channel::bottom_x;
  has_doppler = motion.has(doppler);
  by_bottom = has_doppler && doppler == Channel::bottom_x;
  const bool has_course = motion.has(Channel::north_velocity);
  velocity_from = has_doppler ? doppler : has_course ? Channel::north_velocity : Channel::north;
  has_velocity = has_doppler || has_course || (motion.has(Channel::north) && motion.has(Channel::east));
  const Channel depth = motion.has(Channel::gauge_depth) ? Channel::gauge_depth : Channel::depth;
  const auto z = static_cast<Channel>(static_cast<std::size_t>(doppler) + 2);
  for (std::size_t k = 0; k < rows; ++k) {
    const Eigen::Vector3d angles = euler(k);
    Eigen::Vector3d rate = three(Channel::rate_x, k);
    for (std::size_t i = 0; i < 3; ++i) {
      const auto angle = static_cast<Channel>(static_cast<std::size_t>(Channel::roll) + i);
      if (values[i].empty()) rate[static_cast<Eigen::Index>(i)] = motion.has(angle) ? slope(angle, k) : 0;
    }
    rates.push_back(rate);
    if (has_doppler) {
      velocity.emplace_back(at(doppler, k), three(doppler, k).y(), or_zero(z, k));
      velocity.back() -= rate.cross(motion.doppler_place_m);
    } else {
      velocity.push_back(base::rotation_of({angles.x(), angles.y(), angles.z()}).transpose() *
                         Eigen::Vector3d(has_course ? at(Channel::north_velocity, k) : slope(Channel::north, k),
                                         has_course ? at(Channel::east_velocity, k) : slope(Channel::east, k),
                                         motion.has(depth) ? slope(depth, k) : 0));
    }
  }
}

}  // namespace navcal::identify
