// SPDX-License-Identifier: Apache-2.0
#include "web/outlets/signalk_subscription.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "web/outlets/json_members.h"

namespace navcal::web {
namespace {

/// Paths of Signal K are shorter.
constexpr std::size_t kMaxPattern = 200;
/// Paths of this server are fewer.
constexpr std::size_t kMaxPacers = 256;
constexpr double kMaxPeriod_ms = 3'600'000;
constexpr std::string_view kSelf = "vessels.self";

/// Period of one entry of `subscribe`. The policy "fixed" repeats at `period`; the others send what is new, at
/// most once in `minPeriod`.
std::chrono::milliseconds signalk_period(const nlohmann::json& entry) {
  const bool is_fixed = text_in(entry, "policy") == "fixed" || !entry.contains("minPeriod");
  const char* key = is_fixed && text_in(entry, "policy") != "instant" ? "period" : "minPeriod";
  const double period_ms = number_in(entry, key).value_or(0);
  return std::chrono::milliseconds(static_cast<long>(std::clamp(period_ms, 0.0, kMaxPeriod_ms)));
}

std::optional<std::string> refusal_of_request(const nlohmann::json& message) {
  const std::string id = text_in(message, "requestId");
  if (id.empty() || id.size() > kMaxPattern) return std::nullopt;
  if (!message.contains("put") && !message.contains("delete") && !message.contains("login")) return std::nullopt;
  const nlohmann::ordered_json reply{{"requestId", id},
                                     {"state", "COMPLETED"},
                                     {"statusCode", 405},
                                     {"message", "navcal-web is read-only for Signal K"}};
  return reply.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace

bool matches_pattern(std::string_view pattern, std::string_view path) {
  std::size_t p = 0, t = 0;
  std::size_t star = std::string_view::npos, retry = 0;
  while (t < path.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      retry = t;
    } else if (p < pattern.size() && pattern[p] == path[t]) {
      ++p;
      ++t;
    } else if (star != std::string_view::npos) {
      p = star + 1;
      t = ++retry;
    } else {
      return false;
    }
  }
  return pattern.find_first_not_of('*', p) == std::string_view::npos;
}

SignalKSubscriptions::Outcome SignalKSubscriptions::take(std::string_view text) {
  Outcome outcome;
  const auto message = nlohmann::json::parse(text, nullptr, false);
  if (!message.is_object()) return outcome;
  if (is_self(message)) {
    take_unsubscribe(member_of(message, "unsubscribe"));
    outcome.has_new = take_subscribe(member_of(message, "subscribe"));
  }
  outcome.reply = refusal_of_request(message);
  return outcome;
}

void SignalKSubscriptions::subscribe(std::string pattern, Clock::duration period) {
  period = std::max<Clock::duration>(period, kMinPeriod);
  for (Wanted& wanted : wanted_) {
    if (wanted.pattern != pattern) continue;
    wanted.period = period;
    return;
  }
  if (wanted_.size() < kMaxPatterns) wanted_.push_back({std::move(pattern), period});
}

bool SignalKSubscriptions::is_due(std::string_view path, Clock::time_point now) {
  const auto period = period_of(path);
  if (!period) return false;
  auto found = pacers_.find(path);
  if (found == pacers_.end()) {
    if (pacers_.size() >= kMaxPacers) return false;
    found = pacers_.emplace(path, Pacer()).first;
  }
  return found->second.pass(now, *period);
}

/// Without a context a message is about this vessel.
bool SignalKSubscriptions::is_self(const nlohmann::json& message) const {
  if (!message.contains("context")) return true;
  const std::string context = text_in(message, "context");
  return matches_pattern(context.substr(0, kMaxPattern), self_) || context == kSelf;
}

bool SignalKSubscriptions::take_subscribe(const nlohmann::json& list) {
  if (!list.is_array()) return false;
  bool has_new = false;
  for (const auto& entry : list) {
    std::string path = entry.is_object() ? text_in(entry, "path") : std::string();
    if (path.empty() || path.size() > kMaxPattern) continue;
    subscribe(std::move(path), signalk_period(entry));
    has_new = true;
  }
  return has_new;
}

void SignalKSubscriptions::take_unsubscribe(const nlohmann::json& list) {
  if (!list.is_array()) return;
  for (const auto& entry : list) {
    const std::string path = entry.is_object() ? text_in(entry, "path") : std::string();
    if (path.empty() || path.size() > kMaxPattern) continue;
    std::erase_if(wanted_, [&](const Wanted& wanted) { return matches_pattern(path, wanted.pattern); });
  }
}

/// The shortest period of the patterns that match.
std::optional<SignalKSubscriptions::Clock::duration> SignalKSubscriptions::period_of(std::string_view path) const {
  std::optional<Clock::duration> period;
  for (const Wanted& wanted : wanted_) {
    if ((!period || wanted.period < *period) && matches_pattern(wanted.pattern, path)) period = wanted.period;
  }
  return period;
}

}  // namespace navcal::web
