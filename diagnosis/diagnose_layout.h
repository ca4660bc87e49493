// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "config/layout.h"
#include "config/vehicle.h"
#include "diagnosis/cause_search.h"
#include "diagnosis/nominal_bank.h"
#include "gap/verdict/request.h"
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

/// A diagnosis together with what it rests on, for steps that go on from it.
struct LayoutStudy {
  LayoutRequest request;
  LayoutRecordings recordings;
  CauseLibrary library;
  std::unique_ptr<ModelSource> source;
  NominalBank bank;
  std::optional<CauseSearchResult> found;  ///< nullopt: no recording can be judged
  gap::Diagnosis diagnosis;
};

/// A vehicle file as a layout, to be compared with nominal recordings. Without them its floor is simulated (gap).
[[nodiscard]] config::Layout layout_of(const config::VehicleSettings& vehicle);

/// Diagnoses the recordings of a study that has its library and source; the bank is made if it has none. Throws
/// std::invalid_argument in words where a recording cannot be judged.
void find_causes(LayoutStudy& study, const gap::Progress& progress);

/// Diagnoses recordings (docs/gap.md, "Vehicles with a layout"). Throws std::invalid_argument for an excluded
/// name that is no cause. A recording that cannot be diagnosed gets the verdict `unknown` and remarks that say
/// why.
[[nodiscard]] std::unique_ptr<LayoutStudy> study(LayoutRequest request, LayoutRecordings recordings,
                                                 const gap::Progress& progress);
[[nodiscard]] gap::Diagnosis diagnose(const LayoutRequest& request, const LayoutRecordings& recordings,
                                      const gap::Progress& progress);

/// The same of files: captures or logs. Of `files` recordings, settings, window, exclusions, seed and threads
/// count. A file that is given twice counts once. Throws record::BadRecording for a file that is no recording, and
/// std::invalid_argument for a field or a number of null missions, which a layout has no use for.
[[nodiscard]] std::unique_ptr<LayoutStudy> study(const gap::Request& files, LayoutRequest request,
                                                 const std::vector<std::filesystem::path>& nominals,
                                                 const gap::Progress& progress);
[[nodiscard]] gap::Diagnosis diagnose(const gap::Request& files, LayoutRequest request,
                                      const std::vector<std::filesystem::path>& nominals,
                                      const gap::Progress& progress);

}  // namespace navcal::diagnosis
