// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <utility>

#include "protocols/described/plan.h"
#include "protocols/stream_parser.h"

namespace navcal::protocols::described {

/// Finds the frames of a described device. One without a description finds none.
///
/// A line without start characters begins behind the end of the line before it, so the scanner is told the byte
/// before a candidate. Without a checksum the first line of a stream is left out: its beginning may be missing.
class Scanner {
 public:
  static constexpr std::size_t kMaxFrameLength = described::kMaxFrameLength;

  Scanner() = default;
  explicit Scanner(std::shared_ptr<const Plan> plan)
      : plan_(std::move(plan)), line_begins_(plan_ && plan_->beginning_counts) {}

  [[nodiscard]] const std::uint8_t* find_start(const std::uint8_t* first, const std::uint8_t* last) const {
    if (!plan_) return last;
    if (plan_->sole_start >= 0) return find_byte(first, last, static_cast<std::uint8_t>(plan_->sole_start));
    return find_any_start(first, last);
  }
  [[nodiscard]] Scan scan(const std::uint8_t* first, const std::uint8_t* last) const {
    if (plan_->kinds.size() == 1 && !plan_->any_starts_anywhere)
      return scan_kind(plan_->kinds.front(), first, last);
    return scan_kinds(first, last);
  }
  /// The parser has left all bytes up to this one, as a frame or skipped.
  void left(std::uint8_t byte) {
    if (plan_ && plan_->any_starts_anywhere) line_begins_ = plan_->ends[byte];
  }

 private:
  [[nodiscard]] const std::uint8_t* find_any_start(const std::uint8_t* first, const std::uint8_t* last) const;
  [[nodiscard]] Scan scan_kinds(const std::uint8_t* first, const std::uint8_t* last) const;
  [[nodiscard]] static Scan scan_kind(const KindPlan& kind, const std::uint8_t* first, const std::uint8_t* last);

  std::shared_ptr<const Plan> plan_;
  bool line_begins_ = false;
};

using Parser = StreamParser<Scanner>;

}  // namespace navcal::protocols::described
