#pragma once

#include <Eigen/Core>

#include "gap/null_bank.h"

namespace navcal::gap {

/// What the instruments' noise alone makes of a score, design^T innovations, in the mean. A replay is led by its
/// instruments, so that the same noise is in a mission's signatures and in its innovations: on a zigzag it speaks
/// for a latency of the card of 18 ms and for fins quicker by 19 ms, ten standard errors each. Taken from
/// simulated missions, steered as the recorded one, of a vehicle that is its model exactly, each by its own
/// signatures: of one within tolerance the mean would hold what cannot be negative. A number for each unknown;
/// zeros if no simulated vehicle could follow.
[[nodiscard]] Eigen::VectorXd noise_score(const Replay& recorded, const Course10Hz& course,
                                          const config::VehicleSettings& vehicle, const Library& library,
                                          const Whitening& whitening, const BankOptions& options);

}  // namespace navcal::gap
