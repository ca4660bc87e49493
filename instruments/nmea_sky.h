// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "instruments/samples.h"
#include "protocols/nmea_position.h"

namespace navcal::instruments {

/// Satellites in view from the GSV sentences of all talkers (GP, GL, GA, ...), those in use from GSA.
class NmeaSky {
 public:
  void add_used(const protocols::nmea::Gsa& gsa);
  /// The sky as it stands when a talker's group of sentences is complete.
  std::optional<SkySample> add(std::string_view talker, const protocols::nmea::Gsv& gsv);

 private:
  [[nodiscard]] bool is_used(std::uint16_t number) const;

  SkySample sky_;
  std::array<std::uint16_t, SkySample::kMaxSatellites> talkers_{};  ///< of each satellite
  std::vector<std::uint16_t> used_;  ///< of the newest GSA sentences, one for each system
  bool used_is_whole_ = false;       ///< the next GSA begins anew
};

}  // namespace navcal::instruments
