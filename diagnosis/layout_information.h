// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <vector>

#include "config/layout.h"
#include "gap/verdict/information.h"

namespace navcal::diagnosis {

/// Information of a recording about all causes of its layout, each of a part by its words: "thrust_scale of
/// thruster.2".
struct LayoutInformation {
  gap::InformationResult result;
  /// Standard deviation between vehicles of the layout, and of what the nominal recordings leave open: the same in
  /// all recordings of one vehicle; typical values.
  Eigen::VectorXd vehicle_error;
};

/// The same as gap::information_of(), zero being the vehicle of the nominal recordings. Its own departures in this
/// recording are integrated out. It is linearised about the best set of causes.
[[nodiscard]] LayoutInformation information_of(const gap::Request& request, const config::Layout& layout,
                                               const std::vector<std::filesystem::path>& nominals,
                                               const gap::Progress& progress);

}  // namespace navcal::diagnosis
