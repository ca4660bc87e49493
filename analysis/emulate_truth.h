// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "record/whole_file.h"
#include "sim/state.h"

namespace navcal::analysis {

/// The true motion of the emulated vehicle, 100 rows a second (sim/truth.h). The file appears when it is finished.
class EmulateTruth {
 public:
  /// Time 0 is `start_ns` (UTC). Throws std::system_error.
  EmulateTruth(const std::filesystem::path& file, const sim::Motion& motion, std::int64_t start_ns);

  /// Writes the rows up to `now_ns`, which never goes back. Throws sim::UnstableVehicle, std::system_error.
  void advance(std::int64_t now_ns);
  /// Gives the file its name, with the rows up to the last advance(), or to where that threw. Throws
  /// std::system_error.
  void finish();

 private:
  record::WholeFile file_;
  const sim::Motion& motion_;
  std::int64_t start_ns_, next_ns_;
  std::string rows_;
};

}  // namespace navcal::analysis
