// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/noise/noise_run.h"
#include "config/settings.h"

namespace navcal::analysis {

/// A key of [instruments] and what the recording says of it.
struct FoundSetting {
  std::string_view key;
  std::vector<const RecordedChannel*> channels;  ///< of one port
  /// In the unit of the key: the root mean square over those channels that show their noise; three digits.
  /// nullopt: none does.
  std::optional<double> value;
};

/// All keys of [instruments] that a channel can give, in the order of the table of channels. The port is the one
/// that [roles] names, else the first whose channels show their noise.
[[nodiscard]] std::vector<FoundSetting> found_settings(const NoiseReport& report,
                                                       const config::Settings& settings);

/// A complete configuration: `settings` with what was found in [instruments], and comments that say where each
/// number comes from, or why there is none. A port of a capture, whose place is not known, gets a name under
/// /dev/navcal. config::parse() accepts the text. Empty when nothing was found.
[[nodiscard]] std::string noise_configuration(const NoiseReport& report, config::Settings settings);

/// Why a channel has no noise to reckon with; empty if it has one.
[[nodiscard]] std::string why_unknown(const RecordedChannel& recorded);

}  // namespace navcal::analysis
