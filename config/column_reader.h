// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "config/csv_map.h"
#include "config/document.h"

namespace navcal::config {

/// Reads the tables [column.NAME] of a map, entry by entry.
class ColumnReader {
 public:
  explicit ColumnReader(std::vector<Problem>& problems) : problems_(problems) {}

  /// An entry whose first key is "column".
  void take(const Entry& entry);
  /// The columns in the order of their names. A map without any is a problem.
  [[nodiscard]] std::vector<CsvColumn> finish();

 private:
  struct Given {
    Entry table;
    CsvColumn column;
    bool has_meaning = false;
    std::optional<Entry> unit, line, from, to;  ///< line: scale or offset, the last of them
    double scale = 1;
    double offset = 0;
  };

  void take_key(Given& given, const Entry& entry);
  void finish_column(const std::string& name, Given& given, std::vector<CsvColumn>& columns);
  [[nodiscard]] bool name_sensor(CsvColumn& column, const Given& given);
  [[nodiscard]] bool draw_curve(CsvColumn& column, const Given& given, const ColumnUnit& unit);
  void complain(const Entry& entry, std::string message);

  std::vector<Problem>& problems_;
  std::map<std::string, Given> columns_;
};

}  // namespace navcal::config
