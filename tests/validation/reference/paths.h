// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <vector>

#include "validation/reference/vehicle.h"

namespace navcal::reference::testing {

/// t, x, y, z, phi, theta, psi, u, v, w, p, q, r, rpm, fin1, fin2, fin3: SI and radians.
using Row = std::array<double, 17>;

/// Empty when there is no such file.
std::vector<Row> read_rows(const std::string& file);
Start start_of(const Row& row);
/// Position and heading of the vehicle against a row.
double position_error_m(const Snapshot& snapshot, const Row& row);
double heading_error_deg(const Snapshot& snapshot, const Row& row);
/// Servo angles in a row.
Vector3 fins_of(const Row& row);

}  // namespace navcal::reference::testing
