// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "calib/correction.h"
#include "calib/suite/report.h"

namespace navcal::record {

/// The correction of one calibrator, angles in degrees: {"scale":1.1,"bias_deg_s":-6.4}; null if there is none.
[[nodiscard]] nlohmann::ordered_json correction_json(const calib::Correction& correction,
                                                     calib::Calibrator calibrator);

/// Values of an estimate by name, angles in degrees: "bias_rad_s" becomes "bias_deg_s"; null for what is not
/// finite.
[[nodiscard]] nlohmann::ordered_json values_json(const std::vector<calib::Quantity>& quantities,
                                                 double calib::Quantity::*which);

/// Steps of the field, [{"time","size_uT":[3],"std_uT":[3],"returned"}]; unknown values are null.
[[nodiscard]] nlohmann::ordered_json steps_json(const std::vector<calib::FieldStep>& steps);
/// The time between them, [{"from","to","readings","spread_raw","spread_calibrated"}]: UTC seconds, standard
/// deviation of the field's size over its mean.
[[nodiscard]] nlohmann::ordered_json segments_json(const std::vector<calib::FieldSegment>& segments);
[[nodiscard]] nlohmann::ordered_json gate_json(const calib::GateCounts& counts);

/// The number, or null when it is not finite.
[[nodiscard]] nlohmann::ordered_json number_json(double value);

/// [[a,b,c],[d,e,f],[g,h,i]], row by row.
[[nodiscard]] nlohmann::ordered_json matrix_json(const Eigen::Matrix3d& matrix);
[[nodiscard]] nlohmann::ordered_json vector_json(const Eigen::Vector3d& vector);

}  // namespace navcal::record
