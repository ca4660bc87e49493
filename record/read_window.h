// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "record/byte_source.h"

namespace navcal::record {

/// A view that moves forward over a source; holds no more than what was asked for, and one chunk.
class ReadWindow {
 public:
  explicit ReadWindow(std::unique_ptr<ByteSource> source) : source_(std::move(source)) {}

  /// Brings at least `n` bytes from the cursor on into view; false when the source ends before.
  bool ensure(std::size_t n);
  /// Brings something into view, if it is not empty; false at the end.
  bool more() { return ensure(1); }
  [[nodiscard]] std::string_view view() const { return {buffer_.data() + begin_, end_ - begin_}; }
  /// Moves the cursor by at most what is in view.
  void advance(std::size_t n) {
    begin_ += n;
    offset_ += n;
  }
  /// Offset of the cursor in the source.
  [[nodiscard]] std::uint64_t offset() const { return offset_; }
  [[nodiscard]] std::uint64_t size() const { return source_->size(); }

 private:
  static constexpr std::size_t kChunk = 256 << 10;

  std::unique_ptr<ByteSource> source_;
  std::vector<char> buffer_;
  std::size_t begin_ = 0;
  std::size_t end_ = 0;
  std::uint64_t offset_ = 0;
};

}  // namespace navcal::record
