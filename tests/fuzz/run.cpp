// SPDX-License-Identifier: Apache-2.0
// Any bytes as a run file: an error that names the file, or a run whose response can be computed.
#include "runs/run.h"

#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "runs/response.h"
#include "tests/fuzz/target.h"

namespace navcal::fuzz::run_target {

NAVCAL_FUZZ(run) {
  using namespace navcal::runs;
  const std::string_view input(reinterpret_cast<const char*>(data), size);
  try {
    const Run run = read_run(input, "fuzz", "fuzz.csv");
    if (run.command_us.cols() < 1 || run.command_us.rows() != run.rows()) std::abort();
    const Response response = response_of(run, {20, 1100});
    if (response.spectrum_dB && !response.spectrum_dB->allFinite()) std::abort();
    for (const double parameter : response.parameters) {
      if (parameter > 1e12) std::abort();
    }
  } catch (const BadRun& error) {
    if (!std::string_view(error.what()).starts_with("fuzz.csv")) std::abort();
  }
  return 0;
}

}  // namespace navcal::fuzz::run_target
