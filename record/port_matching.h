// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "config/settings.h"

namespace navcal::record {

/// Which port of the configuration in use each port of a recording is, by its name.
class PortMatch {
 public:
  PortMatch(const config::Settings& recorded, const config::Settings& used);

  /// nullopt: the configuration has no such port. Throws std::out_of_range for a port that the recording lacks.
  [[nodiscard]] std::optional<std::uint16_t> operator[](std::size_t recorded_port) const {
    return used_.at(recorded_port);
  }
  /// Names of the recorded ports that the configuration lacks.
  [[nodiscard]] const std::vector<std::string>& missing() const { return missing_; }

 private:
  std::vector<std::optional<std::uint16_t>> used_;
  std::vector<std::string> missing_;
};

}  // namespace navcal::record
