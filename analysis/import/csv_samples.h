// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/import/import_sink.h"
#include "analysis/import/port_name.h"
#include "config/csv_map.h"

namespace navcal::analysis {

/// Samples of one row of a CSV file: one for each instrument that the map names, of what the row has.
class CsvSamples {
 public:
  explicit CsvSamples(const config::CsvMap& map);

  /// `values` in the order of the map's columns, in navcal's units.
  void emit(std::int64_t time_ns, const std::vector<std::optional<double>>& values, ImportSink& sink) const;

 private:
  struct Member {
    std::size_t first = 0;                         ///< column of the value, or of the x component
    std::optional<std::size_t> second{}, third{};  ///< of a vector
    std::string key;
  };
  struct Group {
    std::string class_name;
    std::string port;
    std::string message;  ///< "COMPASS compass2"
    std::vector<Member> members;
    std::string quantity, unit;  ///< of a sensor
  };

  std::vector<Group> groups_;
};

}  // namespace navcal::analysis
