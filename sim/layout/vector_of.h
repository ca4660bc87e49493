// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/vectors.h"
#include "config/layout.h"
#include "sim/vehicle/body.h"

namespace navcal::sim {

using base::vector_of;

[[nodiscard]] inline Matrix6 matrix_of(const config::LayoutMatrix& rows) {
  return Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(rows.data());
}

}  // namespace navcal::sim
