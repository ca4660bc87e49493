// SPDX-License-Identifier: Apache-2.0
#include "record/log/log_repair.h"

#include <fmt/format.h>

#include <algorithm>

#include "record/log/log_reader.h"
#include "record/recording.h"

namespace navcal::record {
namespace {

/// Longest stretch that is looked at for being the beginning of a log that never got any further.
constexpr std::size_t kStub = 4096;

/// Nothing but the beginning of an empty log: power was lost before its first records were on the medium.
bool is_stub(ByteSource& source) {
  std::string begin(kStub, '\0');
  std::size_t length = 0;
  while (length < begin.size()) {
    const std::size_t got = source.read(begin.data() + length, begin.size() - length);
    if (got == 0) break;
    length += got;
  }
  const std::size_t used = begin.find_last_not_of('\0', length == 0 ? 0 : length - 1) + 1;
  const std::string empty = empty_log_head();
  return used < empty.size() && std::string_view(begin).substr(0, used) == std::string_view(empty).substr(0, used);
}

/// Makes one damaged stretch into records that every MCAP reader passes over.
std::error_code mask(DiskFile& file, const LogReader::Stretch& stretch) {
  std::uint64_t offset = stretch.offset;
  std::uint64_t rest = stretch.length;
  while (rest >= kRecordHead) {
    // The remainder must be long enough for another record head.
    std::uint64_t length = std::min(rest, kMaxRecord);
    if (rest > length && rest - length < kRecordHead) length -= kRecordHead;
    std::string head(1, static_cast<char>(Opcode::masked));
    append_le(head, length - kRecordHead);
    if (const auto error = file.write_at(offset, head)) return error;
    offset += length;
    rest -= length;
  }
  return {};
}

std::error_code write_end(DiskFile& file, std::uint64_t data_bytes, std::string_view end) {
  if (const auto error = file.truncate(data_bytes)) return error;
  if (const auto error = file.write_at(data_bytes, end)) return error;
  if (const auto error = file.sync()) return error;
  return file.make_read_only();
}

std::error_code finish_stub(DiskFile& file) {
  const std::string head = empty_log_head();
  std::string end;
  McapSummary{}.append_end(end, head.size());
  if (const auto error = file.write_at(0, head)) return error;
  return write_end(file, head.size(), end);
}

std::error_code finish_read(DiskFile& file, const LogReader& log) {
  const auto& findings = log.findings();
  if (findings.finished) return file.make_read_only();
  for (const auto& stretch : findings.stretches) {
    if (const auto error = mask(file, stretch)) return error;
  }
  std::string end;
  log.summary().append_end(end, findings.data_end);
  return write_end(file, findings.data_end, end);
}

}  // namespace

Repair finish_log(Disk& disk, const std::filesystem::path& path) {
  Repair repair;
  repair.file = path.filename().string();
  const auto file = disk.open(path, repair.error);
  if (!file) return repair;
  auto source = disk.read(path, repair.error);
  if (!source) return repair;
  if (is_stub(*source)) {
    repair.cut_bytes = source->size();
    repair.error = finish_stub(*file);
    return repair;
  }
  source = disk.read(path, repair.error);
  if (!source) return repair;
  try {
    LogReader log(std::move(source), repair.file);
    while (log.next()) {
    }
    const auto& findings = log.findings();
    repair.messages = log.summary().messages();
    repair.bad_crc = findings.bad_crc;
    repair.was_finished = findings.finished;
    repair.cut_bytes = findings.tail_bytes;
    for (const auto& stretch : findings.stretches) repair.masked_bytes += stretch.length;
    repair.error = finish_read(*file, log);
  } catch (const BadRecording& bad) {
    repair.error = std::make_error_code(std::errc::illegal_byte_sequence);
    repair.reason = bad.what();
  } catch (const std::system_error& failure) {
    repair.error = failure.code();
  }
  return repair;
}

std::string Repair::message() const {
  if (!reason.empty()) return fmt::format("{} (left as it is)", reason);
  if (error == std::errc::resource_unavailable_try_again) return fmt::format("{}: somebody is writing it", file);
  if (error) return fmt::format("{}: cannot be finished: {}", file, error.message());
  if (was_finished) return fmt::format("{}: is whole, {} messages", file, messages);
  std::string text = fmt::format("{}: finished, {} messages kept, {} bytes after the last whole record removed",
                                 file, messages, cut_bytes);
  if (bad_crc > 0) text += fmt::format(", {} messages whose checksum does not hold", bad_crc);
  if (masked_bytes > 0) text += fmt::format(", {} damaged bytes masked", masked_bytes);
  return text;
}

}  // namespace navcal::record
