// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "config/value.h"

namespace navcal::config {

/// Something said in a configuration file or on the command line.
struct Entry {
  std::vector<std::string> keys;  ///< {"port", "compass", "units", "tilt"}
  Value value;
  unsigned line = 0;                      ///< 0: given on the command line
  std::optional<std::string> plain_text;  ///< of the command line: the value where a text is wanted

  [[nodiscard]] std::string name() const;  ///< "port.compass.units.tilt"
};

/// A complaint about one place, in the words of config::Error.
struct Problem {
  unsigned line = 0;  ///< 0: the command line
  std::string key;    ///< empty: the file as a whole
  std::string message;
};

/// The entries of a file, line by line; tables are entries too. What cannot be read at all is one problem. The
/// tables of the array [[list]], when one is wanted, have the keys "list[1]", "list[2]" and so on.
[[nodiscard]] std::vector<Entry> read_document(std::string_view toml, std::vector<Problem>& problems,
                                               std::string_view list = {});

/// A value, a table or an array of tables of a file, with what lies in it: for files with lists in lists, which
/// entries cannot name.
struct Node {
  std::string name;  ///< "frame[1].field[2].scale"
  std::string key;   ///< "scale"; of a table in an array: the array's
  unsigned line = 0;
  Value value;                 ///< Table for tables and for arrays of tables
  bool is_list = false;        ///< an array of tables
  std::vector<Node> children;  ///< in the order of the file
};

/// The tables of a file; what cannot be read at all is one problem.
[[nodiscard]] Node read_tree(std::string_view toml, std::vector<Problem>& problems);

/// One "key=value" of the command line.
[[nodiscard]] std::optional<Entry> read_override(std::string_view text, std::vector<Problem>& problems);

}  // namespace navcal::config
