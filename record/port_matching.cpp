// SPDX-License-Identifier: Apache-2.0
#include "record/port_matching.h"

#include <fmt/format.h>

#include <algorithm>

namespace navcal::record {

PortMatch::PortMatch(const config::Settings& recorded, const config::Settings& used) {
  for (const auto& port : recorded.ports) {
    const auto found = std::ranges::find(used.ports, port.name, &config::PortSettings::name);
    if (found == used.ports.end()) {
      used_.emplace_back();
      missing_.push_back(port.name);
    } else {
      used_.emplace_back(static_cast<std::uint16_t>(found - used.ports.begin()));
    }
  }
}

std::vector<std::string> PortMatch::remarks(const std::string& file) const {
  std::vector<std::string> remarks;
  for (const std::string& port : missing_)
    remarks.push_back(fmt::format("{}: port {} is not in the configuration: left out", file, port));
  return remarks;
}

void PortMatch::give(const Entry& entry, pipeline::Pipeline& pipeline, pipeline::Sink& sink,
                     std::optional<std::int64_t> arrival_ns) const {
  if (const auto* raw = std::get_if<RawRead>(&entry)) {
    const auto port = (*this)[raw->port];
    if (raw->direction == Direction::received && port)
      pipeline.bytes(*port, arrival_ns.value_or(raw->time_ns), raw->bytes, sink);
  } else if (const auto* change = std::get_if<MappingChange>(&entry)) {
    pipeline.set_mapping(change->mapping, sink);
  }
}

std::optional<protocols::motor_card::Command> sent_command(const Entry& entry) {
  const auto* const raw = std::get_if<RawRead>(&entry);
  if (raw == nullptr || raw->direction == Direction::received) return std::nullopt;
  return protocols::motor_card::decode_command(raw->bytes);
}

}  // namespace navcal::record
