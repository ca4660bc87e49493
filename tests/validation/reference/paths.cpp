// SPDX-License-Identifier: Apache-2.0
#include "tests/validation/reference/paths.h"

#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>

namespace navcal::reference::testing {

std::vector<Row> read_rows(const std::string& file) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);  // names
  std::vector<Row> rows;
  while (std::getline(in, line)) {
    std::istringstream numbers(line);
    Row row{};
    for (double& number : row) {
      numbers >> number;
      numbers.ignore(1);
    }
    rows.push_back(row);
  }
  return rows;
}

Start start_of(const Row& row) {
  Start start;
  start.position_m = {row[1], row[2], row[3]};
  start.world_from_body = attitude(row[4], row[5], row[6]);
  start.velocity_m_s = {row[7], row[8], row[9]};
  start.rate_rad_s = {row[10], row[11], row[12]};
  start.shaft_rev_s = row[13] / 60;
  return start;
}

double position_error_m(const Snapshot& snapshot, const Row& row) {
  return (snapshot.position_m - Vector3(row[1], row[2], row[3])).norm();
}

double heading_error_deg(const Snapshot& snapshot, const Row& row) {
  return std::abs(std::remainder(snapshot.heading_rad() - row[6], 2 * std::numbers::pi)) * 180 / std::numbers::pi;
}

Vector3 fins_of(const Row& row) { return {row[14], row[15], row[16]}; }

}  // namespace navcal::reference::testing
