// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "fleet/causes/calibration_history.h"
#include "fleet/causes/pooled_missions.h"
#include "fleet/plan.h"
#include "fleet/result_store.h"

namespace navcal::fleet {

/// The missions of a plan with an answer of the job `evidence`, and what is to be said of the others.
struct MissionsRead {
  std::vector<FleetMission> missions;
  std::vector<std::string> remarks;
  std::size_t open = 0, failed = 0;  ///< tasks of `evidence` without an answer
};

/// The vehicle of a mission is the one that its recording names (`vehicle.id`), else the folder that the recording
/// lies in. Its design is the nominal vehicle of the task. Its day is the date of the first fix, with the place
/// where several waters were sailed that day. Throws base::Failure (bad input) for an answer that is damaged.
[[nodiscard]] MissionsRead read_missions(const Plan& plan, const ResultStore& results);

/// The values of all accepted calibrations of a plan (job `calibrate`), a series for each value of each
/// instrument. An instrument with a serial number has one series, on whatever vehicle it was. Any other has one
/// for each vehicle. Throws as read_missions().
[[nodiscard]] std::vector<CalibrationHistory> read_calibrations(const Plan& plan, const ResultStore& results);

}  // namespace navcal::fleet
