// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "base/local_plane.h"
#include "web/record.h"

/// Messages in Foxglove's own schemas, computed from records of /gps, /nav and /event.
///
/// Frames. "map" has x east, y north, z up (ENU); its origin is the first position of /nav, at the surface.
/// "vehicle" has x forward, y to port, z up. navcal's own frames have x north, y east, z down (NED) and x forward,
/// y to starboard, z down. Thus a vehicle with heading h, pitch p and roll r there is turned by the yaw pi/2 - h,
/// the pitch -p and the roll r here, about z, then y, then x.
namespace navcal::web::foxglove {

struct Quaternion {
  double x = 0, y = 0, z = 0, w = 1;
};
/// Turns vectors of "vehicle" into those of "map". Radians: heading clockwise from north, pitch nose up, roll
/// starboard down.
[[nodiscard]] Quaternion orientation_in_map(double heading_rad, double pitch_rad, double roll_rad);

/// What one record gives; absent where it gives none.
struct Derived {
  std::optional<std::string> location;   ///< foxglove.LocationFix
  std::optional<std::string> pose;       ///< foxglove.PoseInFrame
  std::optional<std::string> transform;  ///< foxglove.FrameTransform
  std::optional<std::string> log;        ///< foxglove.Log
};

/// Standard error that stands for an unknown one, m: so large that no filter is led by the value.
inline constexpr double kUnknownStd_m = 1e6;

class Deriver {
 public:
  /// `time_ns`: time of validity, UTC. A record that is no JSON object, or of another topic, gives nothing.
  [[nodiscard]] Derived derive(const Record& record, std::int64_t time_ns);

 private:
  /// East and north of the origin, m. The first place becomes the origin, and so does one that is far from it.
  [[nodiscard]] std::array<double, 2> position_in_map(double latitude_deg, double longitude_deg);

  std::optional<base::LocalPlane> origin_;
};

}  // namespace navcal::web::foxglove
