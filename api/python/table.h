// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <navcal/samples.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace navcal::python {

/// Samples of one kind as columns. The first row sets names, types and widths of the columns; each row has to put
/// the same members in the same order. What a row lacks is NaN.
class Table {
 public:
  void begin_row() { next_ = 0; }
  void put(const char* name, const std::optional<double>& value);
  void put(const char* name, const std::optional<api::Vector3>& value);
  void put(const char* name, const std::array<std::optional<double>, 3>& value);
  void put(const char* name, std::int64_t value);
  void put_flag(const char* name, bool value);
  void put_text(const char* name, std::string value);

  /// Name to numpy array (texts: list). The arrays take over the columns' memory; the table is empty then.
  [[nodiscard]] pybind11::dict release();

 private:
  using Numbers = std::vector<double>;
  using Integers = std::vector<std::int64_t>;
  using Flags = std::vector<std::uint8_t>;
  using Texts = std::vector<std::string>;
  struct Column {
    std::string name;
    std::size_t width = 1;
    std::variant<Numbers, Integers, Flags, Texts> values;
  };

  /// The next column of the row, made with `Values` in the first row.
  template <class Values>
  Values& column(const char* name, std::size_t width = 1);

  std::vector<Column> columns_;
  std::size_t next_ = 0;
};

/// Name of the kind of a sample: "compass", "imu", "gps", "motor" ...
[[nodiscard]] const char* name_of(const api::Measurement& value);

/// Appends a sample to the table of its kind: its times, its port, the calibration in force, and its members.
void append(Table& table, const api::Sample& sample);

}  // namespace navcal::python
