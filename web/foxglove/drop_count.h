// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace navcal::web::foxglove {

/// Counts messages that a client missed because it did not read, and words the report. UTC, ns.
class DropCount {
 public:
  void dropped(std::int64_t now_ns);
  /// Words for what was dropped since the last report; nullopt when nothing was, or when the last report is
  /// younger than a second: a client that is slow all the time must not get more reports than messages.
  [[nodiscard]] std::optional<std::string> report(std::int64_t now_ns);
  [[nodiscard]] std::uint64_t total() const { return total_; }

 private:
  std::uint64_t total_ = 0, since_report_ = 0;
  std::int64_t first_ns_ = 0, last_ns_ = 0;
  std::optional<std::int64_t> reported_ns_;
};

}  // namespace navcal::web::foxglove
