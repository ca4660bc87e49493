// SPDX-License-Identifier: Apache-2.0
#include "cli/live/log_link.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <system_error>

#include "base/descriptor.h"
#include "base/failure.h"
#include "base/interruptible.h"
#include "record/json/base64.h"
#include "record/log/checksum.h"
#include "record/log/log_folder.h"

namespace navcal::cli {
namespace {

[[noreturn]] void fail_fetch(const std::string& why) { throw base::Failure(base::Exit::failed, why); }

std::string text_or_nothing(const nlohmann::json& value) {
  return value.is_string() ? value.get<std::string>() : "";
}

/// Bytes that are compared by one checksum.
constexpr std::uint64_t kFetchStep_bytes = 4 << 20;

/// NAME.part, held by this process alone.
class PartFile {
 public:
  explicit PartFile(std::filesystem::path path)
      : path_(std::move(path)), file_(::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0644)) {
    if (!file_) fail("cannot be opened");
    if (::flock(file_.get(), LOCK_EX | LOCK_NB) != 0) fail("another navcal is downloading it");
    struct stat status {};
    if (::fstat(file_.get(), &status) != 0) fail("cannot be read");
    bytes_ = static_cast<std::uint64_t>(status.st_size);
  }
  [[nodiscard]] std::uint64_t bytes() const { return bytes_; }
  void append(std::string_view bytes) {
    while (!bytes.empty()) {
      const ssize_t n = ::pwrite(file_.get(), bytes.data(), bytes.size(), static_cast<off_t>(bytes_));
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) fail("cannot be written");
      bytes_ += static_cast<std::uint64_t>(n);
      bytes.remove_prefix(static_cast<std::size_t>(n));
    }
  }
  void cut(std::uint64_t bytes) {
    if (::ftruncate(file_.get(), static_cast<off_t>(bytes)) != 0) fail("cannot be cut");
    bytes_ = bytes;
  }
  [[nodiscard]] std::uint32_t sum(std::uint64_t offset, std::uint64_t length) const {
    std::string bytes(length, '\0');
    std::size_t done = 0;
    while (done < bytes.size()) {
      const ssize_t n =
          ::pread(file_.get(), bytes.data() + done, bytes.size() - done, static_cast<off_t>(offset + done));
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) fail("cannot be read");
      done += static_cast<std::size_t>(n);
    }
    return record::crc32(bytes);
  }
  /// On the disk, read-only as a finished log is, and under its name unless that is taken.
  void rename_to(const std::filesystem::path& target) const {
    if (::fsync(file_.get()) != 0 || ::fchmod(file_.get(), 0444) != 0) fail("cannot be finished");
    if (::renameat2(AT_FDCWD, path_.c_str(), AT_FDCWD, target.c_str(), RENAME_NOREPLACE) != 0)
      fail("cannot be renamed to " + target.filename().string());
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw std::system_error(base::last_error(), path_.string() + ": " + what);
  }

  std::filesystem::path path_;
  base::Descriptor file_;
  std::uint64_t bytes_ = 0;
};

/// Leading bytes of the part that are those of the log, in steps.
std::uint64_t right_bytes(LogLink& link, const std::string& name, const PartFile& part) {
  std::uint64_t right = 0;
  while (right < part.bytes()) {
    const std::uint64_t length = std::min(kFetchStep_bytes, part.bytes() - right);
    if (link.sum(name, right, length) != part.sum(right, length)) break;
    right += length;
  }
  return right;
}

/// Whether the log is there already. Throws when its name is taken by something else.
bool is_there(const std::filesystem::path& target, const RemoteLog& log) {
  std::error_code error;
  const auto status = std::filesystem::symlink_status(target, error);
  if (status.type() == std::filesystem::file_type::not_found) return false;
  if (std::filesystem::is_regular_file(status) && std::filesystem::file_size(target, error) == log.bytes)
    return true;
  fail_fetch(target.string() + ": there is another file of this name; it is never overwritten");
}

}  // namespace

std::vector<RemoteLog> LogLink::list() {
  std::vector<RemoteLog> logs;
  try {
    for (bool more = true; more;) {
      const auto page = ask_({{"command", "log.list"}, {"after", logs.empty() ? "" : logs.back().name}});
      for (const auto& log : page.at("files"))
        logs.push_back({log.at("name"), log.at("bytes"), log.at("finished"), text_or_nothing(log.at("begin")),
                        text_or_nothing(log.at("end"))});
      more = page.at("more").get<bool>() && !page.at("files").empty();
    }
  } catch (const nlohmann::json::exception& error) {
    fail_fetch(std::string("navcald's list of logs cannot be read: ") + error.what());
  }
  return logs;
}

std::vector<RemoteLog> LogLink::wanted(const std::vector<std::string>& names) {
  std::vector<RemoteLog> logs = list();
  if (names.empty()) {
    std::erase_if(logs, [](const RemoteLog& log) { return !log.finished; });
    return logs;
  }
  std::vector<RemoteLog> wanted;
  for (const std::string& name : names) {
    const auto found = std::ranges::find(logs, name, &RemoteLog::name);
    if (found == logs.end()) throw base::Failure(base::Exit::bad_input, name + ": navcald has no such log");
    wanted.push_back(*found);
  }
  return wanted;
}

std::string LogLink::read(const std::string& name, std::uint64_t offset) {
  try {
    const auto part = ask_({{"command", "log.read"}, {"file", name}, {"offset", offset}, {"length", part_bytes_}});
    auto bytes = record::from_base64(part.at("data").get<std::string>());
    const bool is_right = bytes && part.at("offset") == offset && bytes->size() <= part_bytes_ &&
                          part.at("crc32") == record::crc32(*bytes);
    if (!is_right) fail_fetch(name + ": the checksum of a part is wrong");
    return std::move(*bytes);
  } catch (const nlohmann::json::exception& error) {
    fail_fetch(name + ": navcald's answer cannot be read: " + error.what());
  }
}

std::uint32_t LogLink::sum(const std::string& name, std::uint64_t offset, std::uint64_t length) {
  try {
    const auto part = ask_({{"command", "log.sum"}, {"file", name}, {"offset", offset}, {"length", length}});
    if (part.at("length") != length) fail_fetch(name + ": it is shorter than navcald has said");
    return part.at("crc32").get<std::uint32_t>();
  } catch (const nlohmann::json::exception& error) {
    fail_fetch(name + ": navcald's answer cannot be read: " + error.what());
  }
}

bool fetch_log(LogLink& link, const RemoteLog& log, const std::filesystem::path& target,
               const std::function<void(std::uint64_t bytes)>& progress) {
  // The name comes from the daemon: it must not lead out of the folder.
  if (!record::is_log_name(log.name)) fail_fetch(log.name + ": not the name of a log");
  if (is_there(target, log)) return false;
  PartFile part(target.string() + ".part");
  if (part.bytes() > log.bytes) part.cut(log.bytes);
  part.cut(right_bytes(link, log.name, part));
  while (part.bytes() < log.bytes) {
    if (base::Interruptible::interrupted())
      fail_fetch(fmt::format("interrupted: {}.part has {} of {} bytes; the same command continues",
                             target.filename().string(), part.bytes(), log.bytes));
    const std::string bytes = link.read(log.name, part.bytes());
    if (bytes.empty() || bytes.size() > log.bytes - part.bytes()) fail_fetch(log.name + ": its size has changed");
    part.append(bytes);
    progress(part.bytes());
  }
  if (const std::uint64_t right = right_bytes(link, log.name, part); right < log.bytes) {
    part.cut(right);
    fail_fetch(fmt::format("{}: the bytes from {} on are not those of the log; the same command gets them again",
                           log.name, right));
  }
  part.rename_to(target);
  return true;
}

}  // namespace navcal::cli
