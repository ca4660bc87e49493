// SPDX-License-Identifier: Apache-2.0
#include "record/log/log_shelf.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <tuple>

#include "base/descriptor.h"
#include "record/log/checksum.h"
#include "record/log/mcap_fields.h"

namespace navcal::record {
namespace {

constexpr std::size_t kFooterRecord = kRecordHead + kFooterLength;
/// A longer summary is not one of ours.
constexpr std::uint64_t kMaxSummary_bytes = 1 << 20;

/// Fills `out` from `offset` on; false when the file does not have so much.
bool read_at(int fd, std::uint64_t offset, std::string& out) {
  std::size_t done = 0;
  while (done < out.size()) {
    const ssize_t n = ::pread(fd, out.data() + done, out.size() - done, static_cast<off_t>(offset + done));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    done += static_cast<std::size_t>(n);
  }
  return true;
}

/// The times in the Statistics record of a summary.
std::optional<LogSpan> span_in(std::string_view summary) {
  while (summary.size() > kRecordHead) {
    const auto length = read_le<std::uint64_t>(summary, 1);
    if (length > summary.size() - kRecordHead) return std::nullopt;
    const std::string_view content = summary.substr(kRecordHead, length);
    if (summary[0] == static_cast<char>(Opcode::statistics)) {
      McapFields fields(content);
      const auto messages = fields.integer<std::uint64_t>();
      fields.integer<std::uint16_t>();                              // schemas
      for (int i = 0; i < 4; ++i) fields.integer<std::uint32_t>();  // channels, attachments, metadata, chunks
      const auto begin_ns = fields.integer<std::int64_t>();
      const auto end_ns = fields.integer<std::int64_t>();
      if (!fields.complete() || messages == 0) return std::nullopt;
      return LogSpan{begin_ns, end_ns};
    }
    summary.remove_prefix(kRecordHead + length);
  }
  return std::nullopt;
}

std::optional<LogSpan> span_of(int fd, std::uint64_t size) {
  constexpr std::uint64_t kEnd_bytes = kFooterRecord + kMcapMagic.size();
  if (size < kEnd_bytes) return std::nullopt;
  std::string end(kEnd_bytes, '\0');
  if (!read_at(fd, size - kEnd_bytes, end) || !end.ends_with(kMcapMagic) ||
      end[0] != static_cast<char>(Opcode::footer))
    return std::nullopt;
  const auto begin = read_le<std::uint64_t>(end, kRecordHead);
  if (begin == 0 || begin > size - kEnd_bytes || size - kEnd_bytes - begin > kMaxSummary_bytes)
    return std::nullopt;
  std::string summary(size - kEnd_bytes - begin, '\0');
  return read_at(fd, begin, summary) ? span_in(summary) : std::nullopt;
}

/// A log opened for reading, or why it cannot be.
struct OpenLog {
  base::Descriptor file;
  std::uint64_t size = 0;
  std::string problem;
};

OpenLog open_log(const std::filesystem::path& folder, const std::string& name) {
  OpenLog log;
  if (!is_log_name(name)) {
    log.problem = "that is not the name of a log; log.list has them";
    return log;
  }
  // Not through a link, and without waiting for the writer of a pipe.
  log.file = base::Descriptor(::open((folder / name).c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK));
  struct stat status {};
  if (!log.file || ::fstat(log.file.get(), &status) != 0) {
    const std::error_code error = base::last_error();
    log.problem = error == std::errc::no_such_file_or_directory
                      ? name + ": there is no such log (any more: the oldest are removed to make room)"
                      : fmt::format("{}: {}", name, error.message());
  } else if (!S_ISREG(status.st_mode)) {
    log.problem = name + ": not a regular file";
  }
  log.size = static_cast<std::uint64_t>(status.st_size);
  return log;
}

/// Calls `take(piece)` with the bytes of a part, piece by piece.
template <class Take>
std::variant<LogPart, std::string> take_part(const std::filesystem::path& folder, const std::string& name,
                                             std::uint64_t offset, std::uint64_t length, Take take) {
  const OpenLog log = open_log(folder, name);
  if (!log.problem.empty()) return log.problem;
  if (offset > log.size) return fmt::format("{}: byte {} is behind its end at {}", name, offset, log.size);
  LogPart part;
  part.offset = offset;
  part.size = log.size;
  length = std::min(length, log.size - offset);
  std::string piece;
  while (part.length < length) {
    piece.resize(std::min(kMaxPart_bytes, length - part.length));
    if (!read_at(log.file.get(), offset + part.length, piece))
      return fmt::format("{}: byte {} cannot be read", name, offset + part.length);
    part.crc32 = crc32(piece, part.crc32);
    part.length += piece.size();
    take(piece);
  }
  return part;
}

}  // namespace

ShelfPage list_logs(const std::filesystem::path& folder, std::string_view after, std::size_t limit) {
  ShelfPage page;
  auto entries = real_disk().list(folder, page.error);
  // The counter orders the logs. All counters of up to six digits have the same width, and longer ones are
  // greater.
  const auto key_of = [](std::string_view name) {
    const std::string_view counter = name.substr(name.rfind('-') + 1);
    return std::tuple(counter.size(), counter, name);
  };
  std::erase_if(entries, [&](const DiskEntry& entry) {
    return !is_log_name(entry.name) || (!after.empty() && key_of(entry.name) <= key_of(after));
  });
  std::sort(entries.begin(), entries.end(),
            [&](const DiskEntry& a, const DiskEntry& b) { return key_of(a.name) < key_of(b.name); });
  page.more = entries.size() > limit;
  if (page.more) entries.resize(limit);
  for (auto& entry : entries) {
    ShelvedLog log{std::move(entry.name), entry.bytes, !entry.writable, std::nullopt};
    if (log.finished) {
      const OpenLog open = open_log(folder, log.name);
      if (open.problem.empty()) log.span = span_of(open.file.get(), open.size);
    }
    page.logs.push_back(std::move(log));
  }
  return page;
}

std::variant<LogPart, std::string> read_log(const std::filesystem::path& folder, const std::string& name,
                                            std::uint64_t offset, std::uint64_t length) {
  std::string bytes;
  auto part = take_part(folder, name, offset, std::min(length, kMaxPart_bytes),
                        [&](const std::string& piece) { bytes += piece; });
  if (auto* read = std::get_if<LogPart>(&part)) read->bytes = std::move(bytes);
  return part;
}

std::variant<LogPart, std::string> sum_log(const std::filesystem::path& folder, const std::string& name,
                                           std::uint64_t offset, std::uint64_t length) {
  return take_part(folder, name, offset, std::min(length, kMaxSum_bytes), [](const std::string&) {});
}

}  // namespace navcal::record
