// SPDX-License-Identifier: Apache-2.0
#include "analysis/import/log_readers.h"
#include "record/recording.h"
#include "tests/fuzz/import_sink.h"
#include "tests/fuzz/target.h"

namespace navcal::fuzz::import_slocum_target {

NAVCAL_FUZZ(import_slocum) {
  const std::string_view file(reinterpret_cast<const char*>(data), size);
  static_cast<void>(navcal::analysis::is_slocum(file));
  navcal::fuzz::CheckingSink sink;
  try {
    static_cast<void>(navcal::analysis::read_slocum(file, {}, sink));
  } catch (const navcal::record::BadRecording&) {  // its list of sensors is another file
  }
  return 0;
}

}  // namespace navcal::fuzz::import_slocum_target
