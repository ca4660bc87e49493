// SPDX-License-Identifier: Apache-2.0
#include "record/log/checked_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <iterator>

#include "base/descriptor.h"
#include "record/log/checksum.h"
#include "record/log/mcap_format.h"

namespace navcal::record {
namespace {

constexpr std::string_view kMagic = "navcal checked file 1\n";
constexpr std::size_t kCrcSize = sizeof(std::uint32_t);

std::error_code write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::write(descriptor, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return base::last_error();
    bytes.remove_prefix(static_cast<std::size_t>(n));
  }
  return {};
}

/// Piece by piece, since a copy of a large content would double its memory.
std::error_code write_pieces(int descriptor, std::string_view content) {
  std::string sum;
  append_le(sum, crc32c(content, crc32c(kMagic)));
  for (const std::string_view piece : {kMagic, content, std::string_view(sum)}) {
    if (const auto error = write_all(descriptor, piece)) return error;
  }
  return ::fsync(descriptor) == 0 ? std::error_code{} : base::last_error();
}

}  // namespace

std::error_code write_checked(const std::filesystem::path& file, std::string_view content) {
  const std::filesystem::path part = file.string() + ".part";
  {
    const base::Descriptor out(::open(part.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0640));
    if (out.get() < 0) return base::last_error();
    if (const auto error = write_pieces(out.get(), content)) return error;
  }
  if (::rename(part.c_str(), file.c_str()) != 0) return base::last_error();
  const base::Descriptor folder(::open((file.has_parent_path() ? file.parent_path() : ".").c_str(),
                                       O_RDONLY | O_DIRECTORY | O_CLOEXEC, 0640));
  if (folder.get() < 0 || ::fsync(folder.get()) != 0) return base::last_error();
  return {};
}

CheckedContent read_checked(const std::filesystem::path& file) {
  using State = CheckedContent::State;
  std::ifstream in(file, std::ios::binary);
  if (!in) {
    std::error_code ignored;
    if (!std::filesystem::exists(file, ignored)) return {};
    return {State::damaged, {}, "it cannot be opened"};
  }
  std::string bytes;
  try {
    bytes.assign(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
  } catch (const std::ios_base::failure&) {  // a folder, or an error of the disk
    return {State::damaged, {}, "it cannot be read"};
  }
  if (!bytes.starts_with(kMagic)) return {State::damaged, {}, "its head is not of a checked file"};
  if (bytes.size() < kMagic.size() + kCrcSize) return {State::damaged, {}, "it is cut short"};
  const std::size_t end = bytes.size() - kCrcSize;
  if (read_le<std::uint32_t>(bytes, end) != crc32c(std::string_view(bytes).substr(0, end)))
    return {State::damaged, {}, "its checksum is wrong"};
  return {State::good, bytes.substr(kMagic.size(), end - kMagic.size()), {}};
}

}  // namespace navcal::record
