// SPDX-License-Identifier: Apache-2.0
#include "nav/past_poses.h"

#include "base/angles.h"

namespace navcal::nav {
namespace {

Pose between(const Pose& a, const Pose& b, std::int64_t time_ns) {
  const double share = static_cast<double>(time_ns - a.time_ns) / static_cast<double>(b.time_ns - a.time_ns);
  Pose pose;
  pose.time_ns = time_ns;
  pose.roll_rad = a.roll_rad + share * base::wrapped(b.roll_rad - a.roll_rad);
  pose.pitch_rad = a.pitch_rad + share * (b.pitch_rad - a.pitch_rad);
  pose.heading_rad = a.heading_rad + share * base::wrapped(b.heading_rad - a.heading_rad);
  pose.reckoned_m = a.reckoned_m + share * (b.reckoned_m - a.reckoned_m);
  return pose;
}

}  // namespace

void PastPoses::push(const Pose& pose) {
  // The newest may lie closer to the one before it; it is replaced until they are far enough apart.
  const bool close = count_ >= 2 && entry(count_ - 1).time_ns - entry(count_ - 2).time_ns < kSpacing_ns;
  if (!close && count_ == kCapacity) {
    first_ = (first_ + 1) % kCapacity;
    --count_;
  }
  if (!close) ++count_;
  Pose& newest = entry(count_ - 1);
  newest = pose;
  newest.roll_rad -= corrected_rad_.x();
  newest.pitch_rad -= corrected_rad_.y();
  newest.heading_rad -= corrected_rad_.z();
}

Pose PastPoses::corrected(Pose pose) const {
  pose.roll_rad += corrected_rad_.x();
  pose.pitch_rad += corrected_rad_.y();
  pose.heading_rad += corrected_rad_.z();
  return pose;
}

std::optional<Pose> PastPoses::at(std::int64_t time_ns) const {
  if (count_ == 0 || time_ns < entry(0).time_ns || time_ns > entry(count_ - 1).time_ns + kReach_ns)
    return std::nullopt;
  if (count_ == 1) return corrected(entry(0));
  std::size_t later = 1;
  // From the newest back: readings are late by a few entries.
  for (later = count_ - 1; later > 1 && entry(later - 1).time_ns > time_ns; --later) {
  }
  return corrected(between(entry(later - 1), entry(later), time_ns));
}

}  // namespace navcal::nav
