// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "analysis/import/import_sink.h"

namespace navcal::analysis {

[[nodiscard]] bool is_slocum(std::string_view head);

/// Data of a Slocum glider (.dbd, .sbd, .tbd, .ebd), encoding 5: ASCII header, list of sensors, cycles in which
/// each sensor is new, repeated or absent. Taken are the new values. A file without its list of sensors cannot be
/// read: the remark names the list. docs/import.md has the table of sensors.
[[nodiscard]] ImportFindings read_slocum(std::string_view file, ImportSink& sink);

}  // namespace navcal::analysis
