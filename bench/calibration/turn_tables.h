// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/calibration/tables.h"

namespace navcal::bench {

void print_gyro(const TableOptions& options);     ///< THESIS 11.1
void print_compass(const TableOptions& options);  ///< THESIS 11.2
void print_joint(const TableOptions& options);    ///< THESIS 11.3
void print_drift(const TableOptions& options);    ///< THESIS 11.6, item 7
void print_cost(const TableOptions& options);     ///< of every estimator

}  // namespace navcal::bench
