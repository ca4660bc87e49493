// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "record/export/topic_columns.h"

namespace navcal::record {

/// How the messages of one topic become lines of a table.
class CsvTable {
 public:
  /// Table of a topic with listed members.
  explicit CsvTable(const Topic& topic);

  /// "time_s,...,heading_rad,...\n"
  [[nodiscard]] std::string header() const;
  /// The line of one message; a member that is absent or null is empty. False when it is not JSON.
  [[nodiscard]] bool append_line(std::string& out, std::string_view json) const;

 private:
  std::vector<TopicColumn> columns_;
};

/// Quoted where it must be (RFC 4180).
void append_csv_text(std::string& out, std::string_view text);

}  // namespace navcal::record
