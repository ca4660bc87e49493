// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "record/whole_file.h"

namespace navcal::record {

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

  explicit NetcdfFile(const std::filesystem::path& path);
  NetcdfFile(const NetcdfFile&) = delete;
  NetcdfFile& operator=(const NetcdfFile&) = delete;
  ~NetcdfFile();

  [[nodiscard]] Group root() const { return file_; }
  [[nodiscard]] Group add_group(const std::string& name);
  /// Its number within the group.
  [[nodiscard]] int add_dimension(Group group, const std::string& name, std::size_t length);
  /// Adds a variable of `type` NC_DOUBLE, NC_INT64, NC_BYTE (compressed) or NC_STRING over one dimension.
  [[nodiscard]] Variable add_variable(Group group, const std::string& name, int type, int dimension,
                                      std::size_t length);

  void attribute(Group group, const std::string& name, std::string_view text);
  void attribute(Variable variable, const std::string& name, std::string_view text);
  void attribute(Variable variable, const std::string& name, std::span<const std::int8_t> values);
  void fill_value(Variable variable, double value);
  void fill_value(Variable variable, std::int64_t value);
  void fill_value(Variable variable, std::int8_t value);

  void write(Variable variable, std::span<const double> values);
  void write(Variable variable, std::span<const std::int64_t> values);
  void write(Variable variable, std::span<const std::int8_t> values);
  void write(Variable variable, std::vector<const char*>& texts);

  void commit();

 private:
  void check(int status) const;

  WholeFile disk_;
  int file_ = 0;
  bool open_ = false;
};

}  // namespace navcal::record
