// SPDX-License-Identifier: Apache-2.0
#include "cli/recorded_motions.h"

#include <cstdio>

#include "base/printable.h"

namespace navcal::cli {

std::vector<identify::RecordedMotion> load_motions(const std::vector<std::string>& files,
                                                   const std::optional<config::Settings>& stated,
                                                   analysis::Progress& progress) {
  std::vector<identify::RecordedMotion> motions;
  for (const std::string& file : files) {
    motions.push_back(identify::load_motion(
        file, [&](double done) { progress.show("reading", done); }, stated));
    for (const auto& remark : motions.back().remarks)
      std::fprintf(stderr, "navcal: %s\n", base::printable(remark).c_str());
  }
  return motions;
}

}  // namespace navcal::cli
