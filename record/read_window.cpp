// SPDX-License-Identifier: Apache-2.0
#include "record/read_window.h"

#include <algorithm>
#include <cstring>

namespace navcal::record {

bool ReadWindow::ensure(std::size_t n) {
  if (end_ - begin_ >= n) return true;
  if (begin_ > 0 && begin_ + std::max(n, kChunk) > buffer_.size()) {
    std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
    end_ -= begin_;
    begin_ = 0;
  }
  // Never more than the source has, so that a record that lies about its length takes no memory.
  const auto rest = static_cast<std::size_t>(std::min<std::uint64_t>(source_->size(), SIZE_MAX / 2)) + 1;
  const std::size_t wanted = begin_ + std::min(std::max(n, kChunk), rest);
  if (buffer_.size() < wanted) buffer_.resize(wanted);
  while (end_ - begin_ < n && end_ < buffer_.size()) {
    const std::size_t got = source_->read(buffer_.data() + end_, buffer_.size() - end_);
    if (got == 0) break;
    end_ += got;
  }
  return end_ - begin_ >= n;
}

}  // namespace navcal::record
