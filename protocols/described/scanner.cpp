// SPDX-License-Identifier: Apache-2.0
#include "protocols/described/scanner.h"

#include <algorithm>

#include "protocols/checked_line.h"
#include "protocols/described/text.h"

namespace navcal::protocols::described {
namespace {

std::size_t place_of(int place, std::size_t length) {
  return place < 0 ? length - static_cast<std::size_t>(-place) : static_cast<std::size_t>(place);
}

bool begins_with(const std::uint8_t* first, std::size_t available, std::size_t at, const std::string& bytes) {
  if (available <= at) return true;
  const std::size_t there = std::min(available - at, bytes.size());
  for (std::size_t i = 0; i < there; ++i) {
    if (first[at + i] != static_cast<std::uint8_t>(bytes[i])) return false;
  }
  return true;
}

bool sum_holds(const KindPlan& kind, const std::uint8_t* first, std::size_t length) {
  const Checksum& checksum = kind.checksum;
  const std::size_t from = place_of(checksum.from, length), to = place_of(checksum.to, length);
  const std::uint32_t sum = sum_of(checksum.sum, {first + from, to - from});
  const std::uint8_t* const stated = first + place_of(checksum.at, length);
  const bool is_big = checksum.byte_order == ByteOrder::big;
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < kind.sum_size; ++i)
    value |= std::uint32_t{stated[i]} << 8 * (is_big ? kind.sum_size - 1 - i : i);
  return value == sum;
}

Scan scan_binary(const KindPlan& kind, const std::uint8_t* first, std::size_t available) {
  for (const Constant& constant : kind.constants) {
    if (!begins_with(first, available, constant.at, constant.bytes)) return Scan::not_a_frame();
  }
  std::size_t length = kind.length.fixed;
  if (length == 0) {
    if (available < kind.length.at + size_of(kind.length.type)) return Scan::incomplete(kind.least - available);
    const std::int64_t stated =
        integer_at(first + kind.length.at, kind.length.type, kind.length.byte_order == ByteOrder::big) *
            kind.length.times +
        kind.length.add;
    if (stated < static_cast<std::int64_t>(kind.least) || stated > static_cast<std::int64_t>(kind.longest))
      return Scan::not_a_frame();
    length = static_cast<std::size_t>(stated);
  }
  if (available < length) return Scan::incomplete(length - available);
  if (kind.sum_size > 0 && !sum_holds(kind, first, length)) return Scan::bad_checksum();
  return Scan::frame(length, kind.id);
}

/// The checksum that stands at `digits`, behind its mark.
bool text_sum_holds(const KindPlan& kind, Bytes covered, Bytes digits) {
  if (digits.size() != 2 * kind.sum_size) return false;
  std::uint32_t stated = 0;
  for (const std::uint8_t digit : digits) {
    const std::uint8_t value = protocols::detail::kHexValue[digit];
    if (value > 15) return false;
    stated = stated << 4 | value;
  }
  return stated == sum_of(kind.checksum.sum, covered);
}

/// A line that has come with its end. What it holds decides whether it is a frame.
Scan scan_whole_line(const KindPlan& kind, Bytes line) {
  if (kind.sum_size > 0) {
    const Bytes text = without_end(kind, line);
    const auto mark = std::find(text.rbegin(), text.rend(), static_cast<std::uint8_t>(kind.checksum.mark));
    if (mark == text.rend()) return Scan::bad_checksum();
    const auto at = static_cast<std::size_t>(text.rend() - mark) - 1;
    const auto from = static_cast<std::size_t>(kind.checksum.from);
    if (at < from || at < kind.start.size() ||
        !text_sum_holds(kind, text.subspan(from, at - from), text.subspan(at + 1)))
      return Scan::bad_checksum();
  }
  if (kind.count > 0 && count_fields(kind, body_of(kind, line)) != kind.count) return Scan::not_a_frame();
  return Scan::frame(line.size(), kind.id);
}

/// The fields of an NMEA 0183 line are not counted before its checksum holds.
Scan scan_nmea(const KindPlan& kind, const std::uint8_t* first, const std::uint8_t* last) {
  const Scan scan = scan_checked_line(first, last, kind.longest, kind.id);
  if (scan.kind != Scan::Kind::frame || kind.count == 0) return scan;
  return count_fields(kind, body_of(kind, {first, scan.length})) == kind.count ? scan : Scan::not_a_frame();
}

Scan scan_text(const KindPlan& kind, const std::uint8_t* first, std::size_t available) {
  const std::size_t searched = std::min(available, kind.longest);
  const auto end = static_cast<std::uint8_t>(kind.end);
  std::size_t i = kind.start.size();
  for (; i < searched; ++i) {
    const std::uint8_t byte = first[i];
    if (byte == end) return scan_whole_line(kind, {first, i + 1});
    // The start of another line: this one was cut.
    if (kind.start_is_sign && byte == static_cast<std::uint8_t>(kind.start.front())) return Scan::not_a_frame();
    const bool belongs = byte >= ' ' || byte == '\t' || (byte == '\r' && end == '\n');
    if (!belongs) return Scan::not_a_frame();
  }
  if (searched == kind.longest) return Scan::not_a_frame();
  return Scan::incomplete(i > searched ? i - searched + 1 : 1);
}

}  // namespace

const std::uint8_t* Scanner::find_any_start(const std::uint8_t* first, const std::uint8_t* last) const {
  if (line_begins_) return first;
  if (!plan_->any_starts_anywhere)
    return std::find_if(first, last, [&](std::uint8_t byte) { return plan_->starts[byte]; });
  for (; first != last; ++first) {
    if (plan_->starts[*first]) return first;
    if (plan_->ends[*first]) return first + 1;
  }
  return last;
}

Scan Scanner::scan_kinds(const std::uint8_t* first, const std::uint8_t* last) const {
  bool is_bad = false;
  for (const KindPlan& kind : plan_->kinds) {
    if (kind.starts_anywhere && !line_begins_) continue;
    const Scan scan = scan_kind(kind, first, last);
    // A kind that is stated before others is preferred, so what it may become has to be awaited.
    if (scan.kind == Scan::Kind::frame || scan.kind == Scan::Kind::incomplete) return scan;
    is_bad = is_bad || scan.kind == Scan::Kind::bad_checksum;
  }
  return is_bad ? Scan::bad_checksum() : Scan::not_a_frame();
}

Scan Scanner::scan_kind(const KindPlan& kind, const std::uint8_t* first, const std::uint8_t* last) {
  const auto available = static_cast<std::size_t>(last - first);
  if (!begins_with(first, available, 0, kind.start)) return Scan::not_a_frame();
  if (!kind.is_text) return scan_binary(kind, first, available);
  return kind.is_nmea ? scan_nmea(kind, first, last) : scan_text(kind, first, available);
}

}  // namespace navcal::protocols::described
