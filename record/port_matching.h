// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "config/settings.h"
#include "pipeline/pipeline.h"
#include "protocols/motor_card.h"
#include "record/recording.h"

namespace navcal::record {

/// Which port of the configuration in use each port of a recording is, by its name.
class PortMatch {
 public:
  PortMatch(const config::Settings& recorded, const config::Settings& used);

  /// nullopt: the configuration has no such port. Throws std::out_of_range for a port that the recording lacks.
  [[nodiscard]] std::optional<std::uint16_t> operator[](std::size_t recorded_port) const {
    return used_.at(recorded_port);
  }
  /// "FILE: port NAME is not in the configuration: left out", for each recorded port that the configuration lacks.
  [[nodiscard]] std::vector<std::string> remarks(const std::string& file) const;

  /// Gives what a port of the configuration has received, and changes of UTC, to a pipeline of this configuration.
  /// Other entries are not for it. `arrival_ns` takes the place of the time at which the bytes were read.
  void give(const Entry& entry, pipeline::Pipeline& pipeline, pipeline::Sink& sink,
            std::optional<std::int64_t> arrival_ns = std::nullopt) const;

 private:
  std::vector<std::optional<std::uint16_t>> used_;
  std::vector<std::string> missing_;
};

/// The order to a motor card that the host sent; nullopt: the entry is none.
[[nodiscard]] std::optional<protocols::motor_card::Command> sent_command(const Entry& entry);

}  // namespace navcal::record
