// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <netcdf.h>
#include <netcdf_mem.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/durations.h"
#include "base/utc_text.h"
#include "record/export/export.h"
#include "record/export/log_tables.h"
#include "record/whole_file.h"

namespace navcal::record {
namespace {

/// Values that are compressed together.
constexpr std::size_t kChunk = 65536;
/// More makes files hardly smaller and takes several times as long.
constexpr int kDeflateLevel = 2;
constexpr std::size_t kFirstBytes = 1 << 12;
constexpr const char* kFillValue = "_FillValue";

/// A netCDF-4 file that is being written; a thin cover of the C library that turns its statuses into
/// std::system_error, which names the file. Made in memory, since HDF5 does not survive a disk that is full: it
/// crashes when the process ends. Appears under its name by commit().
class NetcdfFile {
 public:
  /// A group, or the file itself; and a variable in it.
  using Group = int;
  struct Variable {
    Group group = 0;
    int id = 0;
  };

  explicit NetcdfFile(const std::filesystem::path& path) : disk_(path) {
    check(nc_create_mem(path.c_str(), NC_NETCDF4 | NC_CLOBBER, kFirstBytes, &file_));
    open_ = true;
    // Everything is written once: filling it first would write it twice.
    int before = 0;
    check(nc_set_fill(file_, NC_NOFILL, &before));
  }

  NetcdfFile(const NetcdfFile&) = delete;
  NetcdfFile& operator=(const NetcdfFile&) = delete;
  ~NetcdfFile() {
    if (open_) nc_abort(file_);
  }

  [[nodiscard]] Group root() const { return file_; }
  Group add_group(const std::string& name) {
    Group group = 0;
    check(nc_def_grp(file_, name.c_str(), &group));
    return group;
  }

  /// Its number within the group.
  int add_dimension(Group group, const std::string& name, std::size_t length) {
    int dimension = 0;
    check(nc_def_dim(group, name.c_str(), length, &dimension));
    return dimension;
  }

  /// Of `type` NC_DOUBLE, NC_INT64, NC_BYTE (compressed) or NC_STRING, over one dimension.
  Variable add_variable(Group group, const std::string& name, int type, int dimension, std::size_t length) {
    Variable variable{group, 0};
    check(nc_def_var(group, name.c_str(), type, 1, &dimension, &variable.id));
    const std::size_t chunk = std::clamp<std::size_t>(length, 1, kChunk);
    check(nc_def_var_chunking(group, variable.id, NC_CHUNKED, &chunk));
    if (type != NC_STRING) check(nc_def_var_deflate(group, variable.id, 1, 1, kDeflateLevel));
    return variable;
  }

  void attribute(Group group, const std::string& name, std::string_view text) {
    check(nc_put_att_text(group, NC_GLOBAL, name.c_str(), text.size(), text.data()));
  }

  void attribute(Variable variable, const std::string& name, std::string_view text) {
    check(nc_put_att_text(variable.group, variable.id, name.c_str(), text.size(), text.data()));
  }

  void attribute(Variable variable, const std::string& name, std::span<const std::int8_t> values) {
    check(nc_put_att_schar(variable.group, variable.id, name.c_str(), NC_BYTE, values.size(), values.data()));
  }

  void fill_value(Variable variable, double value) {
    check(nc_put_att_double(variable.group, variable.id, kFillValue, NC_DOUBLE, 1, &value));
  }

  void fill_value(Variable variable, std::int64_t value) {
    const long long wide = value;
    check(nc_put_att_longlong(variable.group, variable.id, kFillValue, NC_INT64, 1, &wide));
  }

  void fill_value(Variable variable, std::int8_t value) {
    check(nc_put_att_schar(variable.group, variable.id, kFillValue, NC_BYTE, 1, &value));
  }

  template <class Number>
  void write(Variable variable, const std::vector<Number>& values) {
    check(nc_put_var(variable.group, variable.id, values.data()));
  }

  void write(Variable variable, std::vector<const char*>& texts) {
    check(nc_put_var_string(variable.group, variable.id, texts.data()));
  }

  void commit() {
    open_ = false;
    NC_memio whole{};
    check(nc_close_memio(file_, &whole));
    const std::unique_ptr<void, decltype(&std::free)> bytes(whole.memory, &std::free);
    disk_.write({static_cast<const char*>(bytes.get()), whole.size});
    disk_.commit();
  }

 private:
  void check(int status) const {
    if (status == NC_NOERR) return;
    // Positive: errno. Others are the library's own, and their words its only account.
    if (status > 0) throw std::system_error(status, std::system_category(), disk_.path().string());
    throw std::system_error(std::make_error_code(std::errc::io_error),
                            disk_.path().string() + ": " + nc_strerror(status));
  }

  WholeFile disk_;
  int file_ = 0;
  bool open_ = false;
};

constexpr std::int64_t kDay_ns = 86'400 * base::kSecond_ns;

/// Midnight before the log's first time: seconds since then are exact to the nanosecond in a double, for months,
/// and in units that every reader of dates knows.
std::int64_t reference_of(const std::vector<TopicTable>& tables) {
  std::int64_t first = std::numeric_limits<std::int64_t>::max();
  for (const TopicTable& table : tables) first = std::min(first, std::ranges::min(table.times_ns()));
  return tables.empty() || first < 0 ? 0 : first - first % kDay_ns;
}

std::string units_since(std::int64_t reference_ns) {
  return fmt::format("seconds since {} 00:00:00", base::utc_date_text(reference_ns));
}

int netcdf_type(const TopicTable::Values& values) {
  if (std::holds_alternative<NumberColumn>(values)) return NC_DOUBLE;
  if (const auto* times = std::get_if<NanosecondColumn>(&values)) return times->utc ? NC_DOUBLE : NC_INT64;
  if (std::holds_alternative<BooleanColumn>(values)) return NC_BYTE;
  return NC_STRING;
}

/// Name of a variable, the same as in the other exports, except that the coordinate has its dimension's name, and
/// intervals are in nanoseconds.
std::string variable_name(const TopicTable::Column& column) {
  if (!std::holds_alternative<NanosecondColumn>(column.values)) return column.head.title;
  return std::string(column.head.field->name);
}

/// Axes in words, where the name of the field is that of three columns.
std::string long_name(const TopicColumn& head, std::string_view name) {
  if (head.field->kind != FieldKind::vector3) return std::string(name);
  return fmt::format("{}: {}", name, head.title.substr(head.field->name.size() + 1));
}

/// One topic: a group with a dimension and the variables over it.
class TopicGroup {
 public:
  TopicGroup(NetcdfFile& file, const TopicTable& table, std::int64_t reference_ns)
      : file_(file), table_(table), reference_ns_(reference_ns), group_(file.add_group(table_name(table.topic()))),
        has_coordinate_(table.times_increase()),
        dimension_(file.add_dimension(group_, has_coordinate_ ? "time" : "sample", table.rows())) {
    for (const auto& column : table_.columns()) variables_.push_back(add(column));
  }

  /// A coordinate variable must increase strictly, or it is none.
  [[nodiscard]] bool has_coordinate() const { return has_coordinate_; }

  void write(std::size_t column) {
    const auto variable = variables_[column];
    const auto& values = table_.columns()[column].values;
    if (const auto* texts = std::get_if<TextColumn>(&values)) {
      std::vector<const char*> pointers(texts->size());
      for (std::size_t row = 0; row < texts->size(); ++row) pointers[row] = texts->at(row).c_str();
      file_.write(variable, pointers);
    } else if (const auto* numbers = std::get_if<NumberColumn>(&values)) {
      file_.write(variable, numbers->rows);
    } else if (const auto* times = std::get_if<NanosecondColumn>(&values)) {
      if (times->utc) {
        file_.write(variable, dates(*times));
      } else {
        file_.write(variable, times->rows);
      }
    } else {
      file_.write(variable, std::get<BooleanColumn>(values).rows);
    }
  }

 private:
  NetcdfFile::Variable add(const TopicTable::Column& column) {
    const bool is_coordinate = &column == &table_.columns().front();
    const auto variable =
        file_.add_variable(group_, variable_name(column), netcdf_type(column.values), dimension_, table_.rows());
    const Field& field = *column.head.field;
    if (!field.long_name.empty()) file_.attribute(variable, "long_name", long_name(column.head, field.long_name));
    if (!field.standard_name.empty()) file_.attribute(variable, "standard_name", field.standard_name);
    if (!field.units.empty()) file_.attribute(variable, "units", field.units);
    if (!has_coordinate_ && !is_coordinate) file_.attribute(variable, "coordinates", "time");
    if (std::holds_alternative<NumberColumn>(column.values)) {
      file_.fill_value(variable, std::numeric_limits<double>::quiet_NaN());
    } else if (const auto* times = std::get_if<NanosecondColumn>(&column.values)) {
      if (times->utc) {
        file_.attribute(variable, "units", units_since(reference_ns_));
        file_.attribute(variable, "calendar", "standard");
        // A coordinate has no gaps.
        if (!is_coordinate) file_.fill_value(variable, std::numeric_limits<double>::quiet_NaN());
      } else {
        file_.fill_value(variable, NanosecondColumn::kAbsent);
      }
    } else if (std::holds_alternative<BooleanColumn>(column.values)) {
      file_.fill_value(variable, BooleanColumn::kAbsent);
      file_.attribute(variable, "flag_values", std::array<std::int8_t, 2>{0, 1});
      file_.attribute(variable, "flag_meanings", "false true");
    }
    return variable;
  }

  [[nodiscard]] std::vector<double> dates(const NanosecondColumn& times) const {
    std::vector<double> seconds(times.rows.size());
    std::ranges::transform(times.rows, seconds.begin(), [this](std::int64_t ns) {
      if (ns == NanosecondColumn::kAbsent) return std::numeric_limits<double>::quiet_NaN();
      return static_cast<double>(ns - reference_ns_) / static_cast<double>(base::kSecond_ns);
    });
    return seconds;
  }

  NetcdfFile& file_;
  const TopicTable& table_;
  std::int64_t reference_ns_;
  NetcdfFile::Group group_;
  bool has_coordinate_;
  int dimension_;
  std::vector<NetcdfFile::Variable> variables_;
};

}  // namespace

Exported export_netcdf(const std::filesystem::path& log, const std::filesystem::path& path,
                       const Progress& progress) {
  LogTables found = read_tables(log, progress);
  NetcdfFile file(path);
  // 64-bit integers are allowed from 1.9 on.
  file.attribute(file.root(), "Conventions", "CF-1.9");
  file.attribute(file.root(), "title", "navcal log " + log.filename().string());
  file.attribute(file.root(), "source", "navcal");
  if (!found.configuration.empty()) file.attribute(file.root(), "navcal_configuration", found.configuration);

  Exported exported{{path}, std::move(found.remarks)};
  const std::int64_t reference_ns = reference_of(found.tables);
  for (const TopicTable& table : found.tables) {
    TopicGroup group(file, table, reference_ns);
    if (!group.has_coordinate()) {
      exported.remarks.push_back(
          fmt::format("{}: times do not always increase: its dimension is \"sample\", with the times beside it",
                      table.topic()));
    }
    for (std::size_t column = 0; column < table.columns().size(); ++column) {
      group.write(column);
      progress(1.0);
    }
  }
  file.commit();
  return exported;
}

}  // namespace navcal::record
