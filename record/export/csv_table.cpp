// SPDX-License-Identifier: Apache-2.0
#include "record/export/csv_table.h"

#include "record/json/flat_json.h"

namespace navcal::record {

CsvTable::CsvTable(const Topic& topic) : columns_(topic_columns(topic)) {}

std::string CsvTable::header() const {
  std::string out;
  for (const TopicColumn& column : columns_) {
    if (!out.empty()) out += ',';
    out += column.title;
  }
  out += '\n';
  return out;
}

bool CsvTable::append_line(std::string& out, std::string_view json) const {
  const auto members = FlatJson::parse(json);
  if (!members) return false;
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    if (i > 0) out += ',';
    append_csv_text(out, members->get(columns_[i].member));
  }
  out += '\n';
  return true;
}

void append_csv_text(std::string& out, std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) {
    out += text;
    return;
  }
  out += '"';
  for (const char c : text) {
    if (c == '"') out += '"';
    out += c;
  }
  out += '"';
}

}  // namespace navcal::record
