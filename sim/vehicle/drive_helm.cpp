// SPDX-License-Identifier: Apache-2.0
#include "sim/vehicle/drive_helm.h"

#include <algorithm>

#include "base/vectors.h"

namespace navcal::sim {
namespace {

ActuatorValues positions_in(const PathRow& row) {
  return {{row.rpm}, {row.fins_rad[0], row.fins_rad[1], row.fins_rad[2]}, {}, {}};
}

double part_way(double from, double to, double part) { return from + part * (to - from); }

}  // namespace

DriveHelm::DriveHelm(std::vector<PathRow> rows) : rows_(std::move(rows)) {}

Body DriveHelm::start() const {
  const PathRow& first = rows_.front();
  Body body{base::vector_of(first.position_m), base::vector_of(first.euler_rad), {}};
  body.velocity << base::vector_of(first.velocity_body_m_s), base::vector_of(first.rate_rad_s);
  return body;
}

ActuatorValues DriveHelm::positions_at_start() const { return positions_in(rows_.front()); }

void DriveHelm::next(double time_s, double step_s, const Body& /*body*/, Actuators& actuators) {
  const double wanted_s = rows_.front().t_s + time_s + step_s;
  while (row_ + 2 < rows_.size() && rows_[row_ + 1].t_s <= wanted_s) ++row_;
  const PathRow& a = rows_[row_];
  const PathRow& b = rows_[row_ + 1];
  const double part = std::clamp((wanted_s - a.t_s) / (b.t_s - a.t_s), 0.0, 1.0);
  // Within a millionth of a step: times of a file are decimals.
  finished_ = finished_ || wanted_s > rows_.back().t_s - 1e-6 * step_s;
  actuators.positions.thrusters[0] = part_way(a.rpm, b.rpm, part);
  for (std::size_t i = 0; i < 3; ++i)
    actuators.positions.surfaces_rad[i] = part_way(a.fins_rad[i], b.fins_rad[i], part);
  actuators.commands = actuators.positions;
}

}  // namespace navcal::sim
