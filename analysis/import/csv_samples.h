// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/import/import_sink.h"
#include "analysis/import/port_name.h"
#include "config/csv_map.h"
#include "instruments/sample_fields.h"

namespace navcal::analysis {

/// Samples of one row of a CSV file: one for each instrument that the map names, of what the row has.
class CsvSamples {
 public:
  /// Form of a member of a line.
  enum class Shape : std::uint8_t {
    number,
    vector,  ///< counts when all three components are there
    three,   ///< each of three values counts
  };
  explicit CsvSamples(const config::CsvMap& map);

  /// `values` in the order of the map's columns, in navcal's units.
  void emit(std::int64_t time_ns, const std::vector<std::optional<double>>& values, ImportSink& sink) const;

 private:
  struct Member {
    Shape shape = Shape::number;
    instruments::Form form = instruments::Form::plain;
    std::array<std::optional<std::size_t>, 3> columns{};  ///< the first one, of a number
    std::string key;
  };
  struct Group {
    std::string class_name;
    std::string port;
    std::string message;  ///< "COMPASS compass2"
    std::vector<Member> members;
    std::string quantity, unit;  ///< of a sensor
  };

  [[nodiscard]] static bool write(const Member& member, const std::vector<std::optional<double>>& values,
                                  protocols::samples_line::LineWriter& line);
  Group& group_of(std::string_view class_name, std::string_view port);

  std::vector<Group> groups_;
};

}  // namespace navcal::analysis
