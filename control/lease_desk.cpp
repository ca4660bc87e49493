// SPDX-License-Identifier: Apache-2.0
#include "control/lease_desk.h"

#include <fmt/format.h>

#include <cmath>

namespace navcal::control {
namespace {

std::int64_t expiry_ns(std::int64_t now_ns, double timeout_s) {
  return now_ns + static_cast<std::int64_t>(std::llround(timeout_s * 1e9));
}

}  // namespace

std::string words_for(const Holder& holder) {
  return fmt::format("{} (priority {})", holder.name, holder.priority);
}

std::string LeaseDesk::grant(std::int64_t now_ns, const LeaseRequest& request, std::string token,
                             std::uint64_t client) {
  if (holder_ && holder_->client != client && request.priority <= holder_->priority)
    return "the lease is held by " + words_for(*holder_);
  Holder next{request.holder, request.priority, request.timeout_s, expiry_ns(now_ns, request.timeout_s),
              client,         std::move(token)};
  if (holder_) end(holder_->client == client ? "another lease took its place" : "preempted by " + words_for(next));
  holder_ = std::move(next);
  return {};
}

std::string LeaseDesk::problem_with(std::string_view token) const {
  if (holder_ && holder_->token == token) return {};
  for (const auto& [ended, reason] : ended_) {
    if (ended == token) return reason;
  }
  return "no such lease";
}

void LeaseDesk::renew(std::int64_t now_ns) {
  if (holder_) holder_->expires_ns = expiry_ns(now_ns, holder_->timeout_s);
}

void LeaseDesk::end(std::string reason) {
  if (!holder_) return;
  ended_.emplace_front(std::move(holder_->token), std::move(reason));
  if (ended_.size() > kRemembered) ended_.pop_back();
  holder_.reset();
}

}  // namespace navcal::control
