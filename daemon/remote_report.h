// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "daemon/state_report.h"
#include "link/report.h"
#include "pipeline/pipeline.h"

namespace navcal::daemon {

/// Makes the report in short of the remote link from the state of the vehicle. Each report tells of one
/// calibrator.
class RemoteReport {
 public:
  [[nodiscard]] link::Report of(const VehicleState& state, const pipeline::Pipeline& pipeline,
                                std::int64_t now_ns);

 private:
  std::vector<link::CalibrationState> calibrators_;
  std::size_t next_ = 0;
  std::int64_t calibrators_due_ns_ = 0;
};

}  // namespace navcal::daemon
