// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/calibration/tables.h"

namespace navcal::bench {

/// THESIS 11.4.
void print_magnetometer(const TableOptions& options);
/// The recipe of MAGYC.
void print_magyc(const TableOptions& options);
/// The recordings of others in ../shared/data.
void print_magnetometer_real(const TableOptions& options);
/// Steps of the field by a magnet, and none by iron that is passed.
void print_steps(const TableOptions& options);

}  // namespace navcal::bench
