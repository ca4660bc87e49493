// SPDX-License-Identifier: Apache-2.0
#include "tests/analysis/import/without_channels.h"
#include "tests/fuzz/import_sink.h"
#include "tests/fuzz/target.h"

namespace navcal::fuzz::import_ulog_target {

NAVCAL_FUZZ(import_ulog) {
  const std::string_view file(reinterpret_cast<const char*>(data), size);
  static_cast<void>(navcal::analysis::is_ulog(file));
  navcal::fuzz::CheckingSink sink;
  navcal::fuzz::require_within(navcal::analysis::read_ulog(file, sink), size);
  return 0;
}

}  // namespace navcal::fuzz::import_ulog_target
