// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

/// The tables of docs/calibration.md; each prints itself in Markdown and says what misses its goal.
namespace navcal::bench {

struct TableOptions {
  int runs = 2000;            ///< Monte Carlo runs a row
  std::uint64_t seed = 4001;  ///< the first, of the table of steps
};

struct Table {
  std::string_view name;         ///< as typed on the command line
  std::string_view description;  ///< one line
  void (*print)(const TableOptions& options);
};

/// Every table, in the order of the document.
[[nodiscard]] std::span<const Table> tables();

}  // namespace navcal::bench
