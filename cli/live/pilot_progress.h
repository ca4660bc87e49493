// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "autopilot/pilot.h"

namespace navcal::cli {

/// "3/7 leg, heading 090, depth 1.02 m, speed 1.13 m/s, 2:31 left": where a mission stands.
[[nodiscard]] std::string progress_text(const autopilot::Pilot& pilot, const autopilot::Reading& reading,
                                        double left_s);

/// Prints the progress of a mission to standard error: on a terminal as one line that is redrawn, else as one
/// line per step.
class PilotProgress {
 public:
  PilotProgress();
  ~PilotProgress();
  PilotProgress(const PilotProgress&) = delete;
  PilotProgress& operator=(const PilotProgress&) = delete;

  void show(const autopilot::Pilot& pilot, const autopilot::Reading& reading, double left_s);

 private:
  bool on_terminal_;
  bool drawn_ = false;
  std::string phase_;
};

}  // namespace navcal::cli
