// SPDX-License-Identifier: Apache-2.0
#include "web/foxglove/drop_count.h"

#include <fmt/format.h>

#include "base/utc_text.h"

namespace navcal::web::foxglove {
namespace {

constexpr std::int64_t kBetweenReports_ns = 1'000'000'000;

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
      since_report_, base::utc_text(first_ns_), base::utc_text(last_ns_), total_);
  since_report_ = 0;
  reported_ns_ = now_ns;
  return words;
}

}  // namespace navcal::web::foxglove
