// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "analysis/import/import_sink.h"
#include "config/csv_map.h"

namespace navcal::analysis {

/// A CSV file whose columns have their meaning by `map` (docs/import.md). Vectors count only when all three
/// components are there. A cell that is empty, or that is no number, is absent. Throws record::BadRecording when
/// the header line lacks a column of the map.
[[nodiscard]] ImportFindings read_csv(std::string_view file, const config::CsvMap& map, ImportSink& sink);

}  // namespace navcal::analysis
