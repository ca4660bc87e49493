// SPDX-License-Identifier: Apache-2.0
#include "gap/verdict/diagnosis.h"

#include <cmath>

#include "base/enum_name.h"

namespace navcal::gap {

Track track_of_fixes(const Mission& mission) {
  Track track;
  for (const FixReading& fix : mission.fixes) {
    track.time_s.push_back(fix.time_s);
    track.north_m.push_back(fix.position_m[0]);
    track.east_m.push_back(fix.position_m[1]);
  }
  return track;
}

Track reckoned_track(const Trajectory10Hz& course, const Mission& mission) {
  Track track;
  if (mission.fixes.empty()) return track;
  const FixReading& first = mission.fixes.front();
  double north_m = first.position_m[0], east_m = first.position_m[1];
  for (std::size_t i = 0; i < course.time_s.size(); ++i) {
    if (course.time_s[i] < first.time_s) continue;
    const double level_m = course.surge_m_s[i] * std::cos(course.pitch_rad[i]) * kInterval_s;
    if (!std::isfinite(level_m) || !std::isfinite(course.heading_rad[i])) continue;
    north_m += level_m * std::cos(course.heading_rad[i]);
    east_m += level_m * std::sin(course.heading_rad[i]);
    track.time_s.push_back(course.time_s[i]);
    track.north_m.push_back(north_m);
    track.east_m.push_back(east_m);
  }
  return track;
}

std::string_view name_of(Verdict verdict) {
  return base::enum_name<Verdict::unknown>(verdict, {"no-gap", "explained", "unknown"});
}

std::string_view name_of(UnknownKind kind) {
  return base::enum_name<UnknownKind::cannot_say>(kind, {"ambiguous", "outside", "cannot say"});
}

}  // namespace navcal::gap
