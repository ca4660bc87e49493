// SPDX-License-Identifier: Apache-2.0
#include "web/foxglove/drop_count.h"

#include <fmt/chrono.h>

#include <chrono>

namespace navcal::web::foxglove {
namespace {

constexpr std::int64_t kBetweenReports_ns = 1'000'000'000;

std::string utc_text(std::int64_t time_ns) {
  const std::chrono::sys_time<std::chrono::nanoseconds> time{std::chrono::nanoseconds(time_ns)};
  const auto ms = std::chrono::floor<std::chrono::milliseconds>(time);
  return fmt::format(
      "{:%FT%T}.{:03}Z",
      fmt::gmtime(std::chrono::system_clock::to_time_t(std::chrono::floor<std::chrono::seconds>(time))),
      (ms.time_since_epoch() % std::chrono::seconds(1)).count());
}

}  // namespace

void DropCount::dropped(std::int64_t now_ns) {
  if (since_report_++ == 0) first_ns_ = now_ns;
  last_ns_ = now_ns;
  ++total_;
}

std::optional<std::string> DropCount::report(std::int64_t now_ns) {
  if (since_report_ == 0) return std::nullopt;
  // A clock that stepped back must not keep the report back.
  if (reported_ns_ && now_ns >= *reported_ns_ && now_ns - *reported_ns_ < kBetweenReports_ns) return std::nullopt;
  std::string words = fmt::format(
      "{} messages were dropped from {} to {}, because this program did not read them in "
      "time; {} since it connected",
      since_report_, utc_text(first_ns_), utc_text(last_ns_), total_);
  since_report_ = 0;
  reported_ns_ = now_ns;
  return words;
}

}  // namespace navcal::web::foxglove
