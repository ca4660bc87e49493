#pragma once

#include <span>
#include <vector>

#include "gap/actuator_track.h"

namespace navcal::gap {

/// A way that the servos may have gone, at the times of the rows: through the cleaned reports, under commands that
/// hold from report to report. A helmsman who steers by noisy instruments moves rudder and elevator ten times a
/// second by more than the reports' own noise; so much more as theirs is than that, the way holds. A smooth
/// picture of the fins would make simulated vehicles quieter than the recorded one. `later_s`: by which the
/// commands come after the reports.
[[nodiscard]] std::vector<Vector3> servo_path(std::span<const ActuatorTrack::Row> rows,
                                              std::span<const MotorReading> readings, double servo_lag_s,
                                              double later_s);

}  // namespace navcal::gap
