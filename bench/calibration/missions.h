// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/calibration/tables.h"

namespace navcal::bench {

/// Stated errors of gyro and compass on the shipped missions and the eight paths, by the simulated instruments and
/// the pipeline of the programs.
void print_missions(const TableOptions& options);

}  // namespace navcal::bench
