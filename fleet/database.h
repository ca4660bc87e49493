// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

struct sqlite3;
struct sqlite3_stmt;

namespace navcal::fleet {

/// A database that cannot be read or written; what() names the file and SQLite's reason.
class DatabaseError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// An SQLite file. It is never written where others read it: whoever writes does so under another name, and
/// renames (fleet/whole_writing.h). So readers take no locks, which network file systems do not keep.
class Database {
 public:
  enum class Access : std::uint8_t {
    create,  ///< to be written, and made where it is missing; a power cut may leave half of it
    read,
  };
  /// Throws DatabaseError.
  Database(std::filesystem::path file, Access access);
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;
  ~Database();

  /// Statements without parameters and without answers. Throws DatabaseError.
  void execute(const std::string& sql);
  [[nodiscard]] sqlite3* handle() const { return handle_; }
  [[noreturn]] void fail() const;

 private:
  std::filesystem::path file_;
  sqlite3* handle_ = nullptr;
};

/// A prepared statement. Parameters (?1, ?2 ...) are bound in order. All throw DatabaseError.
class Statement {
 public:
  Statement(Database& database, std::string_view sql);
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;
  ~Statement();

  /// Begins anew with these values: integers, floating-point numbers, texts, nullptr and an empty optional for
  /// NULL.
  template <class... Values>
  Statement& with(const Values&... values) {
    reset();
    int index = 0;
    (bind(++index, values), ...);
    return *this;
  }
  /// The next row; false at the end.
  bool step();
  /// Runs a statement that answers nothing.
  template <class... Values>
  void run(const Values&... values) {
    with(values...).step();
  }
  /// Columns of the row, from 0 on. NULL is an empty text, and 0.
  [[nodiscard]] std::string text(int column) const;
  [[nodiscard]] std::int64_t integer(int column) const;

 private:
  void reset();
  void bind(int index, std::int64_t value);
  void bind(int index, int value) { bind(index, static_cast<std::int64_t>(value)); }
  void bind(int index, std::uint64_t value) { bind(index, static_cast<std::int64_t>(value)); }
  void bind(int index, double value);
  void bind(int index, std::string_view value);
  void bind(int index, const std::string& value) { bind(index, std::string_view(value)); }
  void bind(int index, const char* value) { bind(index, std::string_view(value)); }
  void bind(int index, std::nullptr_t value);
  template <class Value>
  void bind(int index, const std::optional<Value>& value) {
    value ? bind(index, *value) : bind(index, nullptr);
  }

  Database& database_;
  sqlite3_stmt* statement_ = nullptr;
};

}  // namespace navcal::fleet
