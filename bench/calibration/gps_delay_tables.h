// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/calibration/tables.h"

namespace navcal::bench {

void print_gps(const TableOptions& options);
void print_delay(const TableOptions& options);

}  // namespace navcal::bench
