// SPDX-License-Identifier: Apache-2.0
// Readings of any content and order: the calibrators neither crash nor offer what is no number.
#include <cstdlib>

#include "tests/fuzz/calib_readings.h"
#include "tests/fuzz/target.h"

namespace navcal::fuzz::suite_target {

NAVCAL_FUZZ(suite) {
  using namespace navcal::calib;
  Source source({data, size});
  Suite suite({}, {true, true, true, true, true});
  double time_s = 0;
  while (!source.empty()) suite.put(navcal::calib::fuzz::take_reading(source, time_s));
  suite.finish();
  navcal::calib::fuzz::check(suite);
  return 0;
}

}  // namespace navcal::fuzz::suite_target
