// SPDX-License-Identifier: Apache-2.0
#include "tests/calib/thesis_paths.h"

#include "analysis/thesis/thesis_paths.h"

namespace navcal::calib::test {

std::vector<TruePoint> load_true_path(const std::string& name) {
  return analysis::load_thesis_path(NAVCAL_SOURCE_DIR "/fixtures/paths/" + name + ".csv");
}

}  // namespace navcal::calib::test
