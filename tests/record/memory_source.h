// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstring>
#include <string_view>

#include "record/byte_source.h"

namespace navcal::record {

/// Bytes that somebody else keeps.
class MemorySource final : public ByteSource {
 public:
  explicit MemorySource(std::string_view bytes) : size_(bytes.size()), rest_(bytes) {}
  std::size_t read(char* to, std::size_t n) override {
    const std::size_t taken = rest_.size() < n ? rest_.size() : n;
    if (taken > 0) std::memcpy(to, rest_.data(), taken);
    rest_.remove_prefix(taken);
    return taken;
  }
  [[nodiscard]] std::uint64_t size() const override { return size_; }

 private:
  std::uint64_t size_;
  std::string_view rest_;
};

}  // namespace navcal::record
