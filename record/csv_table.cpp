#include "record/csv_table.h"

#include <array>

#include "record/flat_json.h"

namespace navcal::record {

CsvTable::CsvTable(const Topic& topic) {
  constexpr std::array<std::string_view, 3> kAxes{"_x", "_y", "_z"};
  constexpr std::array<std::string_view, 3> kFins{"_1", "_2", "_3"};
  for (const Field& field : topic.fields) {
    const std::string name(field.name);
    if (field.kind == FieldKind::vector3) {
      const auto& endings = field.name.starts_with("fins") ? kFins : kAxes;
      for (std::size_t i = 0; i < endings.size(); ++i) {
        columns_.push_back({name + std::string(endings[i]), name + "." + std::to_string(i)});
      }
    } else {
      columns_.push_back({field.unit.empty() ? name : name + "_" + std::string(field.unit), name});
    }
  }
}

std::string CsvTable::header() const {
  std::string out;
  for (const Column& column : columns_) {
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
