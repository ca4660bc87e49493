// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "config/settings.h"
#include "config/vehicle.h"
#include "gap/data/earth_field.h"
#include "gap/verdict/diagnosis.h"
#include "record/recording.h"

namespace navcal::gap {

/// Request for a diagnosis.
struct Request {
  /// Missions of one vehicle that are diagnosed together: effects are common to all. At least one.
  std::vector<std::filesystem::path> missions;
  std::vector<std::filesystem::path> holdouts;  ///< other missions of the same vehicle; may be none
  config::VehicleSettings vehicle;              ///< the nominal one
  std::optional<config::Settings> settings;     ///< of all recordings, instead of their own
  record::TimeWindow window;                    ///< the part of all recordings that counts
  std::optional<Vector3> field_uT;              ///< the Earth's, for all missions, instead of what they state
  std::vector<Quantity> without;                ///< to be left out of all recordings, as if they were not there
  std::vector<std::string> excluded;            ///< effects that the library is to be without
  std::filesystem::path cache;                  ///< folder of null banks; empty: none are kept
  bool cache_is_read_only = false;              ///< null banks that the folder lacks are made, and not kept
  int bank_missions = 100;
  std::uint64_t bank_seed = 1;
  unsigned threads = 0;  ///< 0: as many as there are cores
};

/// Gets the current step and the share of it that is done (0 to 1). Called from one thread at a time.
using Progress = std::function<void(std::string_view what, double done)>;

/// Diagnoses a recording. Throws record::BadRecording for a file that is no recording. Throws
/// std::invalid_argument for an excluded name that is not in the library, for a request without a mission, and for
/// a recording that shares readings with another one. A recording that cannot be diagnosed gets the verdict
/// `unknown` and remarks that say why.
[[nodiscard]] Diagnosis diagnose(const Request& request, const Progress& progress);

/// A null bank made for later diagnoses.
struct MadeBank {
  int missions = 0;
  std::string shortcoming;  ///< why there is none; empty: it is in the cache
};

/// Makes the null bank of the first of `request.missions` and keeps it in `request.cache`, or finds one there that
/// serves. Throws record::BadRecording, and std::runtime_error where the bank cannot be kept.
[[nodiscard]] MadeBank make_bank(const Request& request, const Progress& progress);

}  // namespace navcal::gap
