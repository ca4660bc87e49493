#include "record/checked_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <iterator>

#include "record/checksum.h"
#include "record/mcap_format.h"

namespace navcal::record {
namespace {

constexpr std::string_view kHead = "navcal checked file 1\n";
constexpr std::size_t kCrcSize = sizeof(std::uint32_t);

/// Closed when it goes.
class Descriptor {
 public:
  Descriptor(const std::filesystem::path& path, int flags)
      : value_(::open(path.c_str(), flags | O_CLOEXEC, 0640)) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (value_ >= 0) ::close(value_);
  }
  [[nodiscard]] int get() const { return value_; }

 private:
  int value_;
};

std::error_code last_error() { return {errno, std::generic_category()}; }

std::error_code write_whole(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::write(descriptor, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return last_error();
    bytes.remove_prefix(static_cast<std::size_t>(n));
  }
  return ::fsync(descriptor) == 0 ? std::error_code{} : last_error();
}

}  // namespace

std::error_code write_checked(const std::filesystem::path& file, std::string_view content) {
  std::string bytes(kHead);
  bytes += content;
  append_le(bytes, crc32c(bytes));
  const std::filesystem::path part = file.string() + ".part";
  {
    const Descriptor out(part, O_WRONLY | O_CREAT | O_TRUNC);
    if (out.get() < 0) return last_error();
    if (const auto error = write_whole(out.get(), bytes)) return error;
  }
  if (::rename(part.c_str(), file.c_str()) != 0) return last_error();
  const Descriptor folder(file.has_parent_path() ? file.parent_path() : ".", O_RDONLY | O_DIRECTORY);
  if (folder.get() < 0 || ::fsync(folder.get()) != 0) return last_error();
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
  std::string bytes((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  if (in.bad()) return {State::damaged, {}, "it cannot be read"};
  if (!bytes.starts_with(kHead)) return {State::damaged, {}, "its head is not of a checked file"};
  if (bytes.size() < kHead.size() + kCrcSize) return {State::damaged, {}, "it is cut short"};
  const std::size_t end = bytes.size() - kCrcSize;
  if (read_le<std::uint32_t>(bytes, end) != crc32c(std::string_view(bytes).substr(0, end)))
    return {State::damaged, {}, "its checksum is wrong"};
  return {State::good, bytes.substr(kHead.size(), end - kHead.size()), {}};
}

}  // namespace navcal::record
