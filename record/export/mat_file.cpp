// SPDX-License-Identifier: Apache-2.0
#include "record/export/mat_file.h"

#include <array>
#include <fstream>

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

}  // namespace

MatFile::MatFile(const std::filesystem::path& path) : path_(path) {
  errno = 0;
  file_.reset(Mat_CreateVer(path_.part().c_str(), kHeader, MAT_FT_MAT5));
  if (!file_) fail();
}

void MatFile::fail() const {
  const int reason = errno != 0 ? errno : EIO;
  throw std::system_error(reason, std::system_category(), path_.path().string());
}

void MatFile::write(const MatVariable& variable) {
  errno = 0;
  if (Mat_VarWrite(file_.get(), variable.get(), MAT_COMPRESSION_ZLIB) != 0) fail();
  written_.emplace_back(variable->name);
}

void MatFile::commit() {
  errno = 0;
  if (Mat_Close(file_.release()) != 0) fail();
  // Its complaints would go to standard error; what counts is said below.
  Mat_LogInitFunc("navcal", [](int, auto*) {});
  file_.reset(Mat_Open(path_.part().c_str(), MAT_ACC_RDONLY));
  for (const std::string& name : written_) {
    errno = 0;
    if (!file_) fail();
    const MatVariable read(Mat_VarReadNext(file_.get()));
    if (!read || name != read->name) fail();
  }
  file_.reset();
  errno = 0;
  if (!is_as_long_as_it_says(path_.part())) fail();
  path_.commit();
}

}  // namespace navcal::record
