// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <matio.h>

#include <algorithm>
#include <array>
#include <boost/locale/encoding_utf.hpp>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "record/export/export.h"
#include "record/export/log_tables.h"
#include "record/whole_file.h"

namespace navcal::record {
namespace {

/// Its first words are what tells a MAT-file; without one of its own the library puts the date there.
constexpr const char* kHeader = "MATLAB 5.0 MAT-file, written by navcal";
constexpr std::streamoff kHeaderBytes = 128;

/// Whether the lengths that stand before the variables are those of the file. (The library reads past a missing
/// end.)
bool is_as_long_as_it_says(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::streamoff end = kHeaderBytes;
  std::array<std::uint32_t, 2> tag{};  // type and length, in this machine's order, as the library writes them
  while (file.seekg(end) && file.read(reinterpret_cast<char*>(tag.data()), sizeof tag)) {
    end += static_cast<std::streamoff>(sizeof tag) + tag[1];
  }
  std::error_code error;
  const auto size = std::filesystem::file_size(path, error);
  return !error && static_cast<std::uintmax_t>(end) == size;
}

struct FreeMatVariable {
  void operator()(matvar_t* variable) const { Mat_VarFree(variable); }
};
using MatVariable = std::unique_ptr<matvar_t, FreeMatVariable>;

/// A MAT-file (level 5, compressed) that is being written; throws std::system_error, which names the file. Appears
/// under its name by commit().
class MatFile {
 public:
  explicit MatFile(const std::filesystem::path& path) : disk_(path) {
    // It is read back below.
    errno = is_written_in_place(path) ? ENOTSUP : 0;
    if (errno != 0) fail();
    file_.reset(Mat_CreateVer(disk_.part().c_str(), kHeader, MAT_FT_MAT5));
    if (!file_) fail();
  }

  void write(const MatVariable& variable) {
    errno = 0;
    if (Mat_VarWrite(file_.get(), variable.get(), MAT_COMPRESSION_ZLIB) != 0) fail();
    written_.emplace_back(variable->name);
  }

  /// matio does not say when the disk took less than it was given: the file is read back before it gets its name.
  void commit() {
    errno = 0;
    if (Mat_Close(file_.release()) != 0) fail();
    // Its complaints would go to standard error; what counts is said below.
    Mat_LogInitFunc("navcal", [](int, auto*) {});
    file_.reset(Mat_Open(disk_.part().c_str(), MAT_ACC_RDONLY));
    for (const std::string& name : written_) {
      errno = 0;
      if (!file_) fail();
      const MatVariable read(Mat_VarReadNext(file_.get()));
      if (!read || name != read->name) fail();
    }
    file_.reset();
    errno = 0;
    if (!is_as_long_as_it_says(disk_.part())) fail();
    disk_.commit();
  }

 private:
  struct Close {
    void operator()(mat_t* file) const { Mat_Close(file); }
  };
  [[noreturn]] void fail() const {
    const int reason = errno != 0 ? errno : EIO;
    throw std::system_error(reason, std::system_category(), disk_.path().string());
  }

  WholeFile disk_;
  std::unique_ptr<mat_t, Close> file_;
  std::vector<std::string> written_;
};

/// A variable of a level-5 file has a length of 32 bits, and MATLAB takes it with a sign.
constexpr std::uint64_t kMaxVariable = (1ULL << 31) - (1ULL << 20);
/// A cell's head and padding, besides its text.
constexpr std::uint64_t kCellBytes = 64;

MatVariable variable(const char* name, matio_classes kind, matio_types type, std::size_t rows, std::size_t columns,
                     const void* data) {
  std::size_t shape[2] = {rows, columns};
  // matio copies what it is given; its interface only forgets to say const.
  MatVariable made(Mat_VarCreate(name, kind, type, 2, shape, const_cast<void*>(data), 0));
  if (!made) throw std::bad_alloc();
  return made;
}

MatVariable doubles(const std::vector<double>& rows) {
  return variable(nullptr, MAT_C_DOUBLE, MAT_T_DOUBLE, rows.size(), 1, rows.data());
}

MatVariable integers(const std::vector<std::int64_t>& rows) {
  return variable(nullptr, MAT_C_INT64, MAT_T_INT64, rows.size(), 1, rows.data());
}

/// MATLAB's characters have 16 bits.
std::u16string characters(const std::string& utf8) { return boost::locale::conv::utf_to_utf<char16_t>(utf8); }

MatVariable text(const char* name, const std::string& value) {
  const std::u16string row = characters(value);
  return variable(name, MAT_C_CHAR, MAT_T_UINT16, row.empty() ? 0 : 1, row.size(), row.data());
}

/// Booleans as numbers, with NaN for an absent value: MATLAB's logical has no third value.
std::vector<double> as_doubles(const BooleanColumn& column) {
  std::vector<double> rows(column.rows.size());
  std::ranges::transform(column.rows, rows.begin(), [](std::int8_t value) {
    return value == BooleanColumn::kAbsent ? std::numeric_limits<double>::quiet_NaN() : static_cast<double>(value);
  });
  return rows;
}

/// To about 0.2 us, which is what a double of UTC seconds holds.
std::vector<double> as_seconds(const NanosecondColumn& column) {
  std::vector<double> rows(column.rows.size());
  std::ranges::transform(column.rows, rows.begin(), [](std::int64_t ns) {
    if (ns == NanosecondColumn::kAbsent) return std::numeric_limits<double>::quiet_NaN();
    const std::int64_t whole_s = ns / 1'000'000'000;
    return static_cast<double>(whole_s) + static_cast<double>(ns % 1'000'000'000) * 1e-9;
  });
  return rows;
}

/// Short words: a matrix of characters, one row each, filled up with blanks, as MATLAB's cellstr() takes it.
MatVariable words(const TextColumn& column) {
  const std::size_t rows = column.size();
  const std::size_t width = std::max<std::size_t>(column.width(), 1);
  std::u16string matrix(rows * width, u' ');  // column after column, as MATLAB has it
  for (std::size_t row = 0; row < rows; ++row) {
    const std::u16string word = characters(column.at(row));  // not longer than in UTF-8
    for (std::size_t i = 0; i < word.size(); ++i) matrix[i * rows + row] = word[i];
  }
  return variable(nullptr, MAT_C_CHAR, MAT_T_UINT16, rows, width, matrix.data());
}

/// Any texts: a cell for each.
MatVariable cells(const TextColumn& column) {
  std::vector<matvar_t*> made;
  made.reserve(column.size());
  for (std::size_t row = 0; row < column.size(); ++row) made.push_back(text(nullptr, column.at(row)).release());
  return variable(nullptr, MAT_C_CELL, MAT_T_CELL, made.size(), 1, made.data());
}

bool has_words(const TopicTable& table) {
  return std::ranges::any_of(table.columns(), [](const auto& column) { return column.head.title == "device"; });
}

std::uint64_t bytes_of(const TopicTable& table) {
  std::uint64_t bytes = 0;
  for (const auto& column : table.columns()) {
    std::uint64_t each = sizeof(double);
    if (std::holds_alternative<NanosecondColumn>(column.values)) each = 2 * sizeof(double);
    if (const auto* texts = std::get_if<TextColumn>(&column.values)) {
      each = sizeof(char16_t) * texts->width() + (has_words(table) ? 0 : kCellBytes);
    }
    bytes += each * table.rows();
  }
  return bytes;
}

/// The fields of a topic's structure, in order.
std::vector<std::pair<std::string, MatVariable>> fields_of(const TopicTable& table) {
  std::vector<std::pair<std::string, MatVariable>> fields;
  for (const auto& column : table.columns()) {
    const std::string& title = column.head.title;
    if (const auto* numbers = std::get_if<NumberColumn>(&column.values)) {
      fields.emplace_back(title, doubles(numbers->rows));
    } else if (const auto* times = std::get_if<NanosecondColumn>(&column.values)) {
      fields.emplace_back(title, doubles(as_seconds(*times)));
      fields.emplace_back(std::string(column.head.field->name) + "_ns", integers(times->rows));
    } else if (const auto* booleans = std::get_if<BooleanColumn>(&column.values)) {
      fields.emplace_back(title, doubles(as_doubles(*booleans)));
    } else {
      const auto& texts = std::get<TextColumn>(column.values);
      fields.emplace_back(title, has_words(table) ? words(texts) : cells(texts));
    }
  }
  return fields;
}

MatVariable structure(const TopicTable& table) {
  auto fields = fields_of(table);
  std::vector<const char*> names;
  for (const auto& [name, values] : fields) names.push_back(name.c_str());
  std::size_t shape[2] = {1, 1};
  MatVariable made(Mat_VarCreateStruct(table_name(table.topic()).c_str(), 2, shape, names.data(),
                                       static_cast<unsigned>(names.size())));
  if (!made) throw std::bad_alloc();
  for (auto& [name, values] : fields) Mat_VarSetStructFieldByName(made.get(), name.c_str(), 0, values.release());
  return made;
}

}  // namespace

Exported export_mat(const std::filesystem::path& log, const std::filesystem::path& path,
                    const Progress& progress) {
  LogTables found = read_tables(log, progress);
  for (const TopicTable& table : found.tables) {
    const std::uint64_t bytes = bytes_of(table);
    if (bytes > kMaxVariable) {
      throw std::system_error(
          std::make_error_code(std::errc::file_too_large),
          fmt::format("{}: {} takes {} MB, and a variable of a MAT-file at most {} MB: --netcdf has no such limit",
                      path.string(), table.topic(), bytes / 1'000'000, kMaxVariable / 1'000'000));
    }
  }
  MatFile file(path);
  for (const TopicTable& table : found.tables) {
    file.write(structure(table));
    progress(1.0);
  }
  if (!found.configuration.empty()) file.write(text("configuration", found.configuration));
  file.commit();
  return {{path}, std::move(found.remarks)};
}

}  // namespace navcal::record
