// SPDX-License-Identifier: Apache-2.0
#include "sim/vehicle/drive_helm.h"

#include <algorithm>

#include "base/vectors.h"

namespace navcal::sim {
namespace {

Actuators actuators_of(const PathRow& row) { return {base::vector_of(row.fins_rad), row.rpm / 60, row.rpm / 60}; }

}  // namespace

DriveHelm::DriveHelm(std::vector<PathRow> rows) : rows_(std::move(rows)) {}

Body DriveHelm::start() const {
  const PathRow& first = rows_.front();
  Body body{base::vector_of(first.position_m), base::vector_of(first.euler_rad), {}};
  body.velocity << base::vector_of(first.velocity_body_m_s), base::vector_of(first.rate_rad_s);
  return body;
}

Actuators DriveHelm::actuators_at_start() const { return actuators_of(rows_.front()); }

Actuators DriveHelm::next(double time_s, double step_s, const Body& /*body*/) {
  const double wanted_s = rows_.front().t_s + time_s + step_s;
  while (row_ + 2 < rows_.size() && rows_[row_ + 1].t_s <= wanted_s) ++row_;
  const PathRow& a = rows_[row_];
  const PathRow& b = rows_[row_ + 1];
  const double part = std::clamp((wanted_s - a.t_s) / (b.t_s - a.t_s), 0.0, 1.0);
  // Within a millionth of a step: times of a file are decimals.
  finished_ = finished_ || wanted_s > rows_.back().t_s - 1e-6 * step_s;
  const Actuators from = actuators_of(a), to = actuators_of(b);
  const double shaft_rps = from.shaft_rps + part * (to.shaft_rps - from.shaft_rps);
  return {from.fins_rad + part * (to.fins_rad - from.fins_rad), shaft_rps, shaft_rps};
}

}  // namespace navcal::sim
