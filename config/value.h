// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace navcal::config {

/// A [table].
struct Table {
  bool operator==(const Table&) const = default;
};

/// Something that no option takes; the words for it in a message ("an array of tables").
struct Unsupported {
  std::string words;

  bool operator==(const Unsupported&) const = default;
};

/// A value as it stands in a file, in the unit of the file.
using Value = std::variant<Table, Unsupported, bool, std::int64_t, double, std::string, std::vector<double>,
                           std::vector<std::string>>;

/// A value as a message quotes it: `the text "10 ms"`, `the number 3.5`, `a table`.
[[nodiscard]] std::string words_for(const Value& value);

/// A value as TOML writes it; the shortest number that reads back to the same bits.
[[nodiscard]] std::string to_toml_text(const Value& value);

}  // namespace navcal::config
