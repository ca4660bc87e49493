// SPDX-License-Identifier: Apache-2.0
#include "cli/recorded_motions.h"

#include "cli/result_file.h"

namespace navcal::cli {

std::vector<identify::RecordedMotion> load_motions(const std::vector<std::string>& files,
                                                   const std::optional<config::Settings>& stated,
                                                   analysis::Progress& progress) {
  std::vector<identify::RecordedMotion> motions;
  for (const std::string& file : files) {
    motions.push_back(identify::load_motion(
        file, [&](double done) { progress.show("reading", done); }, stated));
    tell_remarks("navcal", motions.back().remarks);
  }
  return motions;
}

}  // namespace navcal::cli
