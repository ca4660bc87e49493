// SPDX-License-Identifier: Apache-2.0
#include "fleet/database.h"

#include <sqlite3.h>

#include <utility>

namespace navcal::fleet {
namespace {

/// A file name as an address of SQLite's, in which ?, # and % would have a meaning.
std::string address_of(const std::filesystem::path& file) {
  std::string address = "file:";
  for (const char c : file.string()) {
    if (c == '?') {
      address += "%3f";
    } else if (c == '#') {
      address += "%23";
    } else if (c == '%') {
      address += "%25";
    } else {
      address += c;
    }
  }
  return address;
}

}  // namespace

Database::Database(std::filesystem::path file, Access access) : file_(std::move(file)) {
  const bool reads = access == Access::read;
  const std::string address = address_of(file_) + (reads ? "?immutable=1" : "");
  const int flags = SQLITE_OPEN_URI | (reads ? SQLITE_OPEN_READONLY : SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE);
  if (sqlite3_open_v2(address.c_str(), &handle_, flags, nullptr) != SQLITE_OK) {
    const std::string reason = handle_ == nullptr ? "out of memory" : sqlite3_errmsg(handle_);
    sqlite3_close(handle_);
    throw DatabaseError(file_.string() + ": " + reason);
  }
  try {
    // Nobody else sees the file before it is whole, so there is nothing to roll back to.
    execute(reads ? "PRAGMA query_only=1" : "PRAGMA journal_mode=OFF; PRAGMA synchronous=OFF");
  } catch (...) {
    sqlite3_close(handle_);
    throw;
  }
}

Database::~Database() { sqlite3_close(handle_); }

void Database::execute(const std::string& sql) {
  if (sqlite3_exec(handle_, sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) fail();
}

void Database::fail() const { throw DatabaseError(file_.string() + ": " + sqlite3_errmsg(handle_)); }

Statement::Statement(Database& database, std::string_view sql) : database_(database) {
  if (sqlite3_prepare_v2(database.handle(), sql.data(), static_cast<int>(sql.size()), &statement_, nullptr) !=
      SQLITE_OK) {
    database.fail();
  }
}

Statement::~Statement() { sqlite3_finalize(statement_); }

bool Statement::step() {
  const int result = sqlite3_step(statement_);
  if (result != SQLITE_ROW && result != SQLITE_DONE) database_.fail();
  return result == SQLITE_ROW;
}

std::string Statement::text(int column) const {
  const auto* const bytes = reinterpret_cast<const char*>(sqlite3_column_text(statement_, column));
  if (bytes == nullptr) return {};
  return {bytes, static_cast<std::size_t>(sqlite3_column_bytes(statement_, column))};
}

std::int64_t Statement::integer(int column) const { return sqlite3_column_int64(statement_, column); }

void Statement::reset() { sqlite3_reset(statement_); }

void Statement::bind(int index, std::int64_t value) {
  if (sqlite3_bind_int64(statement_, index, value) != SQLITE_OK) database_.fail();
}

void Statement::bind(int index, double value) {
  if (sqlite3_bind_double(statement_, index, value) != SQLITE_OK) database_.fail();
}

void Statement::bind(int index, std::string_view value) {
  const auto size = static_cast<int>(value.size());
  if (sqlite3_bind_text(statement_, index, value.data(), size, SQLITE_TRANSIENT) != SQLITE_OK) database_.fail();
}

void Statement::bind(int index, std::nullptr_t /*value*/) {
  if (sqlite3_bind_null(statement_, index) != SQLITE_OK) database_.fail();
}

}  // namespace navcal::fleet
