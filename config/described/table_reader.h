// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "config/document.h"

namespace navcal::config {

/// Reads the keys of one table of a file, and notes what is wrong with them. Keys that were never asked for are
/// unknown. What a reader returns is nullopt when the key is missing or wrong; missing is no problem.
class TableReader {
 public:
  TableReader(const Node& table, std::vector<Problem>& problems) : table_(table), problems_(problems) {}
  TableReader(const TableReader&) = delete;
  TableReader& operator=(const TableReader&) = delete;

  [[nodiscard]] std::optional<std::string> text(std::string_view key);
  /// `unit` is for the message.
  [[nodiscard]] std::optional<double> number(std::string_view key, double low, double high,
                                             std::string_view unit = {});
  [[nodiscard]] std::optional<std::int64_t> whole(std::string_view key, std::int64_t low, std::int64_t high);
  [[nodiscard]] std::optional<std::string> choice(std::string_view key, const std::vector<std::string>& known);
  [[nodiscard]] std::vector<std::string> texts(std::string_view key);
  /// Two whole numbers.
  [[nodiscard]] std::optional<std::pair<int, int>> pair(std::string_view key, int low, int high);
  /// The tables of an array of tables, or one table as an array of one.
  [[nodiscard]] std::vector<const Node*> tables(std::string_view key);
  /// A text of bytes in hexadecimal, "A5 5A".
  [[nodiscard]] std::optional<std::string> bytes(std::string_view key);
  /// A text of exactly one character.
  [[nodiscard]] std::optional<char> character(std::string_view key);

  /// The key as it stands in the file; nullptr: it is missing. It counts as known from now on.
  [[nodiscard]] const Node* find(std::string_view key);
  [[nodiscard]] bool has(std::string_view key) { return find(key) != nullptr; }
  /// Notes a problem with a key, or with the table where the key is missing.
  void complain(std::string_view key, std::string message);
  /// Notes that a key is missing.
  void require(std::string_view key, std::string_view what);
  /// Notes every key that was not asked for.
  void finish();

 private:
  /// Notes that a key has a value of another kind than wanted.
  void refuse(const Node& node, std::string_view wanted);

  const Node& table_;
  std::vector<Problem>& problems_;
  std::vector<std::string> known_;
};

/// "A5 5A" as bytes; nullopt when it is not hexadecimal.
[[nodiscard]] std::optional<std::string> bytes_of_hex(std::string_view text);

}  // namespace navcal::config
