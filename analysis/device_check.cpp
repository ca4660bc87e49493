// SPDX-License-Identifier: Apache-2.0
#include "analysis/device_check.h"

#include <algorithm>
#include <cmath>
#include <deque>

#include "analysis/decode_stream.h"
#include "protocols/described/reading.h"
#include "protocols/described/scanner.h"

namespace navcal::analysis {
namespace {

using protocols::described::Description;
using protocols::described::Field;
using protocols::described::FrameKind;
using protocols::described::FrameReader;

constexpr std::size_t kShownRuns = 5;
constexpr std::size_t kShownBytes = 16;

/// Collects what the fields of one kind of frame say.
class KindStatistics {
 public:
  KindStatistics(const FrameKind& kind, bool is_text)
      : kind_(kind), reader_(kind, is_text), plain_(kind.fields.size()), sample_(kind.fields.size()),
        before_(kind.fields.size(), NAN) {
    finding.id = kind.id;
    for (const Field& field : kind.fields) {
      FieldFinding& added = finding.fields.emplace_back();
      added.name = field.name;
      added.unit = field.unit;
    }
  }

  void take(protocols::Bytes frame, std::optional<std::int64_t> arrival_ns) {
    ++finding.frames;
    if (!reader_.read(frame, sample_)) ++finding.impossible;
    reader_.read_plain(frame, plain_);
    for (std::size_t i = 0; i < plain_.size(); ++i) take_value(i);
    if (!arrival_ns) return;
    if (!first_ns_) first_ns_ = arrival_ns;
    last_ns_ = arrival_ns;
    if (*last_ns_ > *first_ns_)
      finding.rate_Hz =
          static_cast<double>(finding.frames - 1) / (static_cast<double>(*last_ns_ - *first_ns_) * 1e-9);
  }

  KindFinding finding;

 private:
  void take_value(std::size_t i) {
    FieldFinding& field = finding.fields[i];
    const double value = plain_[i];
    if (std::isnan(value)) {
      ++field.absent;
      return;
    }
    const Field& described = kind_.fields[i];
    const auto& meaning = info_of(described.meaning);
    const bool is_beyond = (described.low && value < *described.low) ||
                           (described.high && value > *described.high) || sample_[i] < meaning.low ||
                           sample_[i] > meaning.high;
    if (is_beyond) ++field.impossible;
    if (!std::isnan(before_[i]) && before_[i] != value) ++field.changes;
    before_[i] = value;
    ++field.values;
    field.low = field.values == 1 ? value : std::min(field.low, value);
    field.high = field.values == 1 ? value : std::max(field.high, value);
    field.mean += (value - field.mean) / static_cast<double>(field.values);
  }

  const FrameKind& kind_;
  FrameReader reader_;
  std::vector<double> plain_, sample_, before_;
  std::optional<std::int64_t> first_ns_, last_ns_;
};

/// Bytes behind the newest frame, so that the beginning of what was skipped can be shown. Of a long run only the
/// beginning is kept.
class RecentBytes {
 public:
  void add(std::uint64_t offset, protocols::Bytes bytes) {
    if (bytes_.empty()) begin_ = offset;
    if (begin_ + bytes_.size() != offset || bytes_.size() > kKept) return;
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  }
  void forget_before(std::uint64_t offset) {
    const auto gone = static_cast<std::ptrdiff_t>(std::min<std::uint64_t>(offset - begin_, bytes_.size()));
    bytes_.erase(bytes_.begin(), bytes_.begin() + gone);
    begin_ += static_cast<std::uint64_t>(gone);
  }
  [[nodiscard]] std::string at(std::uint64_t offset, std::size_t length) const {
    std::string out;
    for (std::uint64_t i = offset; i < offset + length && i >= begin_ && i < begin_ + bytes_.size(); ++i)
      out += static_cast<char>(bytes_[static_cast<std::size_t>(i - begin_)]);
    return out;
  }

 private:
  static constexpr std::size_t kKept = 4096;

  std::vector<std::uint8_t> bytes_;
  std::uint64_t begin_ = 0;
};

}  // namespace

DeviceFindings check_device(const Description& description, const std::function<TimedBytes()>& next) {
  DeviceFindings findings;
  std::deque<KindStatistics> kinds;
  for (const FrameKind& kind : description.kinds) kinds.emplace_back(kind, description.is_text);
  RecentBytes recent;
  std::optional<std::int64_t> arrival_ns;
  std::uint64_t read = 0, framed_until = 0;
  const auto note_skipped = [&](std::uint64_t until) {
    if (until <= framed_until) return;
    ++findings.skipped_runs;
    if (findings.skipped.size() >= kShownRuns) return;
    const std::uint64_t length = until - framed_until;
    findings.skipped.push_back(
        {framed_until, length,
         recent.at(framed_until, static_cast<std::size_t>(std::min<std::uint64_t>(length, kShownBytes)))});
  };
  findings.summary = decode_stream(
      [&] {
        recent.forget_before(framed_until);
        const TimedBytes piece = next();
        if (piece.bytes.empty()) return piece.bytes;
        arrival_ns = piece.arrival_ns;
        recent.add(read, piece.bytes);
        read += piece.bytes.size();
        return piece.bytes;
      },
      [&](const protocols::Frame& frame) {
        note_skipped(frame.offset);
        framed_until = frame.end();
        for (KindStatistics& kind : kinds) {
          if (kind.finding.id == frame.id) kind.take(frame.bytes, arrival_ns);
        }
      },
      protocols::described::Scanner(protocols::described::compile(description)));
  note_skipped(read - findings.summary.incomplete_bytes);
  for (KindStatistics& kind : kinds) findings.kinds.push_back(std::move(kind.finding));
  findings.warnings = warnings_about(description, findings);
  return findings;
}

}  // namespace navcal::analysis
