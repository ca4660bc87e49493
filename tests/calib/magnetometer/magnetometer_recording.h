// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

/// The field in the recordings of others in ../shared/data, which are not ours to keep here.
namespace navcal::calib::test {

struct RecordedField {
  double time_s = 0;  ///< since the first reading
  Eigen::Vector3d field_body_uT = Eigen::Vector3d::Zero();
  double roll_rad = 0, pitch_rad = 0;  ///< not a number where the device says that it is beyond its range
};

/// Empty where there is no such file.
[[nodiscard]] std::vector<RecordedField> recorded_field(const std::string& file);

/// Standard deviation of a size over its mean, in percent.
[[nodiscard]] double spread_percent(const std::vector<double>& sizes);

}  // namespace navcal::calib::test
