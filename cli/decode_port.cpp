// SPDX-License-Identifier: Apache-2.0
#include "cli/decode_port.h"

#include <fmt/format.h>

#include <utility>

#include "cli/commands.h"

namespace navcal::cli {

PortBytes::PortBytes(const std::string& file, const std::string& port)
    : recording_(record::Recording::open(file)) {
  const auto& ports = recording_->settings().ports;
  std::string names;
  for (; port_ < ports.size(); ++port_) {
    if (ports[port_].name == port) return;
    names += (names.empty() ? "" : ", ") + ports[port_].name;
  }
  throw analysis::Failure(analysis::Exit::usage,
                          fmt::format("{}: no port \"{}\"; its ports: {}", file, port, names));
}

protocols::Protocol PortBytes::protocol() const { return recording_->settings().ports[port_].protocol; }

protocols::Bytes PortBytes::next() {
  while (auto entry = recording_->next()) {
    auto* const read = std::get_if<record::RawRead>(&*entry);
    if (read == nullptr || read->port != port_ || read->direction != record::Direction::received) continue;
    bytes_ = std::move(read->bytes);
    arrival_ns_ = read->time_ns;
    if (!bytes_.empty()) return bytes_;
  }
  return {};
}

}  // namespace navcal::cli
