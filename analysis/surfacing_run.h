// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "config/settings.h"
#include "pipeline/pipeline.h"
#include "record/seen_recordings.h"

namespace navcal::analysis {

/// A surfacing of a recording, with the error of the dead reckoning that its first fix showed.
struct RecordedSurfacing {
  std::string file;
  std::int64_t first_fix_utc_ns = 0;
  pipeline::Surfacing surfacing;
  // After a stretch of 10 s or more without fixes.
  std::optional<double> distance_m;  ///< way through the water in it
  std::optional<double> error_m;     ///< from the position reckoned to the fix
  std::optional<double> std_m;       ///< of error_m, as stated before the fix
  std::optional<double> error_uncalibrated_m;
};

/// Surfacings of recordings, by the same pipeline as in the daemon. The estimate of the position is always on.
class SurfacingRun final : private pipeline::Sink {
 public:
  explicit SurfacingRun(const config::Settings& settings);

  /// Throws record::BadRecording. A file that begins within a minute of the end of the last goes on with it.
  /// False, with a remark: a recording that was played before.
  bool play(const std::string& file);
  [[nodiscard]] const std::vector<RecordedSurfacing>& surfacings() const { return surfacings_; }
  [[nodiscard]] const std::vector<std::string>& remarks() const { return remarks_; }
  [[nodiscard]] const config::Settings& settings() const { return settings_; }

 private:
  void on_navigation(const pipeline::NavigationSample& sample) override;
  void begin_file(std::int64_t time_ns);

  config::Settings settings_;
  std::unique_ptr<pipeline::Pipeline> pipeline_;
  std::string file_;
  std::int64_t newest_ns_ = 0;
  std::vector<RecordedSurfacing> surfacings_;
  std::vector<std::string> remarks_;
  record::SeenRecordings seen_;
};

}  // namespace navcal::analysis
