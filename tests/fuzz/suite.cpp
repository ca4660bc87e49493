// SPDX-License-Identifier: Apache-2.0
// Readings of any content and order: the calibrators neither crash nor offer what is no number.
#include <cstdlib>

#include "tests/fuzz/calib_readings.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace navcal::calib;
  fuzz::Source source({data, size});
  Suite suite({}, {true, true, true, true, true});
  double time_s = 0;
  while (!source.empty()) suite.put(fuzz::take_reading(source, time_s));
  suite.finish();
  fuzz::check(suite);
  return 0;
}
