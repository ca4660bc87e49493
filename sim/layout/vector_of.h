// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "config/layout.h"
#include "sim/vehicle/body.h"

namespace navcal::sim {

[[nodiscard]] inline Eigen::Vector3d vector_of(const config::LayoutVector& v) { return {v[0], v[1], v[2]}; }

[[nodiscard]] inline Matrix6 matrix_of(const config::LayoutMatrix& rows) {
  return Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(rows.data());
}

}  // namespace navcal::sim
