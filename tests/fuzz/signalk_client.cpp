// SPDX-License-Identifier: Apache-2.0
// Whatever a Signal K client sends: bounds hold, and an answer is JSON. One message a line.
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string_view>

#include "tests/fuzz/target.h"
#include "web/outlets/signalk.h"

namespace navcal::fuzz::signalk_client_target {

NAVCAL_FUZZ(signalk_client) {
  using navcal::web::SignalKSubscriptions;
  SignalKSubscriptions subscriptions("vessels.urn:mrn:imo:mmsi:230012345");
  SignalKSubscriptions::Clock::time_point now(std::chrono::hours(1));
  std::string_view text(reinterpret_cast<const char*>(data), size);
  while (!text.empty()) {
    const auto end = text.find('\n');
    const auto outcome = subscriptions.take(text.substr(0, end));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    if (outcome.reply && !nlohmann::json::accept(*outcome.reply)) std::abort();
    if (subscriptions.patterns() > SignalKSubscriptions::kMaxPatterns) std::abort();
    for (const char* path : {"navigation.position", "navigation.headingTrue.standardError"}) {
      const bool is_due = subscriptions.is_due(path, now);
      if (is_due && subscriptions.is_due(path, now + std::chrono::milliseconds(50))) std::abort();
      if (is_due && !subscriptions.is_wanted(path)) std::abort();
    }
    now += std::chrono::milliseconds(100);
  }
  return 0;
}

}  // namespace navcal::fuzz::signalk_client_target
