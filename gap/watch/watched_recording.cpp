// SPDX-License-Identifier: Apache-2.0
#include "gap/watch/watched_recording.h"

#include "base/angles.h"
#include "gap/data/mission.h"
#include "protocols/motor_card.h"
#include "record/port_matching.h"
#include "record/recording.h"

namespace navcal::gap {

void watch_recording(const std::filesystem::path& file, const std::optional<config::Settings>& settings,
                     Watch& watch, const std::function<bool(double)>& go_on) {
  const auto recording = record::Recording::open(file);
  const config::Settings& used = settings ? *settings : recording->settings();
  const record::PortMatch ports(recording->settings(), used);
  pipeline::Pipeline pipeline(samples_only(used));
  while (const auto entry = recording->next()) {
    if (const auto* raw = std::get_if<record::RawRead>(&*entry)) {
      if (raw->direction == record::Direction::received) {
        if (const auto port = ports[raw->port]) pipeline.bytes(*port, raw->time_ns, raw->bytes, watch);
      } else if (const auto command = protocols::motor_card::decode_command(raw->bytes)) {
        Order order{0, static_cast<double>(command->rpm), {}};
        for (std::size_t i = 0; i < order.fins_rad.size(); ++i)
          order.fins_rad[i] = command->fins_deg[i] * base::kRadiansPerDegree;
        watch.on_order(raw->time_ns, order);
      }
    } else if (const auto* change = std::get_if<record::MappingChange>(&*entry)) {
      pipeline.set_mapping(change->mapping, watch);
    }
    if (!go_on(recording->progress())) return;
  }
  watch.finish();
}

}  // namespace navcal::gap
