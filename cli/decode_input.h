#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "protocols/frame.h"

namespace navcal::cli {

/// A file, or standard input for "-", read from its beginning in large blocks. Throws Failure (bad input, the file
/// named) when it cannot be opened or read.
class Input {
 public:
  explicit Input(const std::string& file);
  ~Input();
  Input(const Input&) = delete;
  Input& operator=(const Input&) = delete;

  /// The next bytes, valid until the next call; empty at the end.
  protocols::Bytes next();
  /// Of a regular file; nullopt for pipes and devices.
  [[nodiscard]] std::optional<std::uint64_t> size() const { return size_; }

 private:
  static constexpr std::size_t kBlock = std::size_t{256} << 10;

  std::string name_;
  int descriptor_ = -1;
  std::optional<std::uint64_t> size_;
  std::vector<std::uint8_t> block_;
};

}  // namespace navcal::cli
