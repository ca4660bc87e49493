// SPDX-License-Identifier: Apache-2.0
#include "gap/data/instruments_alone.h"

#include <cmath>

#include "pipeline/pipeline.h"
#include "record/port_matching.h"

namespace navcal::gap {

calib::Report instruments_alone(const std::filesystem::path& file, const std::optional<config::Settings>& stated,
                                const EarthField& field, const std::function<void(double)>& progress,
                                const record::TimeWindow& window) {
  const auto recording = record::Recording::open(file, window);
  config::Settings settings = stated.value_or(recording->settings());
  const record::PortMatch ports(recording->settings(), settings);
  settings.calibration.enabled = settings.calibration.automatic = true;
  settings.navigation.enabled = false;
  if (field.source != EarthField::Source::fitted) {
    const auto& [north_uT, east_uT, down_uT] = field.north_east_down_uT;
    settings.environment.declination_rad = std::atan2(east_uT, north_uT);
  }
  pipeline::Pipeline pipeline(settings);
  pipeline::Sink nobody;
  while (const auto entry = recording->next()) {
    ports.give(*entry, pipeline, nobody);
    progress(recording->progress());
  }
  pipeline.finish_calibration(nobody);
  return pipeline.calibration_report();
}

}  // namespace navcal::gap
