// SPDX-License-Identifier: Apache-2.0
#include "cli/recorded_motions.h"

#include "cli/live/result_file.h"

namespace navcal::cli {

std::vector<identify::RecordedMotion> load_motions(const std::vector<std::string>& files,
                                                   const std::optional<config::Settings>& stated,
                                                   base::Progress& progress, record::SeenRecordings& seen,
                                                   const record::TimeWindow& window) {
  std::vector<identify::RecordedMotion> motions;
  for (const std::string& file : files) {
    std::vector<std::string> remarks;
    if (seen.is_new(file, remarks)) {
      motions.push_back(identify::load_motion(
          file, [&](double done) { progress.show("reading", done); }, stated, window));
      remarks.insert(remarks.end(), motions.back().remarks.begin(), motions.back().remarks.end());
    }
    tell_remarks("navcal", remarks);
  }
  return motions;
}

}  // namespace navcal::cli
