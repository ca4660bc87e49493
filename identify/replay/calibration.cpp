// SPDX-License-Identifier: Apache-2.0
#include "identify/replay/calibration.h"

#include <charconv>

#include "base/line_reader.h"
#include "base/text_rows.h"

namespace navcal::identify {

/// Rows of nuisances.txt in the order of Nuisance: name, standard deviation and unit.
const char* nuisance_rows();

const std::array<NuisanceDescription, static_cast<std::size_t>(kNuisances)>& nuisances() {
  static const auto kAll = [] {
    std::array<NuisanceDescription, static_cast<std::size_t>(kNuisances)> all{};
    const auto rows = base::text_rows(nuisance_rows(), ": ");
    for (std::size_t i = 0; i < all.size(); ++i) {
      const auto& [name, number] = rows.at(i);
      const char* const end = number.data() + number.size();
      const char* const unit = std::from_chars(number.data(), end, all[i].prior_std).ptr;
      all[i].name = name;
      all[i].unit = base::trimmed({unit, end});
    }
    return all;
  }();
  return kAll;
}

std::optional<Nuisance> delay_of(Channel channel) {
  if (channel <= Channel::force_z || channel == Channel::depth) return Nuisance::imu_delay;
  if (channel == Channel::heading) return Nuisance::heading_delay;
  if (channel >= Channel::bottom_x && channel <= Channel::water_z) return Nuisance::doppler_delay;
  if (channel >= Channel::north) return Nuisance::fix_delay;
  return std::nullopt;
}

Calibration nuisance_stds(const RecordedMotion& motion) {
  Calibration stds;
  for (std::size_t i = 0; i < nuisances().size(); ++i)
    stds[static_cast<Eigen::Index>(i)] = nuisances()[i].prior_std;
  if (motion.declination_is_stated) stds[static_cast<Eigen::Index>(Nuisance::heading_offset)] = 0.05;
  if (motion.gyro_turn_on_rad_s > 0) stds.head<4>().setConstant(motion.gyro_turn_on_rad_s);
  return stds;
}

}  // namespace navcal::identify
