// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "config/layout.h"
#include "config/settings.h"
#include "gap/data/silence.h"
#include "gap/verdict/diagnosis.h"
#include "identify/data/recorded_motion.h"

namespace navcal::diagnosis {

/// Request for a diagnosis of a recording of a vehicle that a layout describes.
struct LayoutRequest {
  config::Layout layout;              ///< numbers with standard errors are its tolerances
  std::vector<std::string> excluded;  ///< effects that the library is to be without
  std::uint64_t seed = 1;
  unsigned threads = 0;  ///< 0: as many as there are cores
  /// Judges by mean forces over steady stretches alone. Else that is done where the layout cannot follow a
  /// recording.
  bool is_steady = false;
};

struct LayoutRecordings {
  identify::RecordedMotion recording;
  std::vector<identify::RecordedMotion> holdouts;  ///< other recordings of the same vehicle; may be none
  std::vector<identify::RecordedMotion>
      nominals;  ///< recordings without a gap, which give the floor; without any no cause is named
  /// Recordings with the same causes, which are diagnosed together with `recording`; may be none. One that cannot
  /// be judged is left out, with a remark.
  std::vector<identify::RecordedMotion> others{};

  /// `recording` and `others`.
  [[nodiscard]] std::vector<const identify::RecordedMotion*> together() const;
};

/// The same as files: captures or logs.
struct LayoutFiles {
  std::filesystem::path recording;
  std::vector<std::filesystem::path> holdouts, nominals;
  std::optional<config::Settings> settings;  ///< of all recordings, instead of their own
  record::TimeWindow window{};               ///< the part of all recordings that counts
  std::vector<gap::Quantity> without{};      ///< left out of all recordings
  std::vector<std::filesystem::path> others{};
};

/// Gets the current step and the share of it that is done (0 to 1); may throw to end the work.
using LayoutProgress = std::function<void(std::string_view what, double done)>;

/// Diagnoses recordings (docs/gap.md, "Vehicles with a layout"). Throws std::invalid_argument for an excluded
/// name that is no cause. A recording that cannot be diagnosed gets the verdict `unknown` and remarks that say
/// why.
[[nodiscard]] gap::Diagnosis diagnose(const LayoutRequest& request, const LayoutRecordings& recordings,
                                      const LayoutProgress& progress);

/// Throws record::BadRecording for a file that is no recording.
[[nodiscard]] LayoutRecordings load(const LayoutFiles& files, const LayoutProgress& progress);

}  // namespace navcal::diagnosis
