// SPDX-License-Identifier: Apache-2.0
#include "control/motor_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace navcal::control {
namespace {

/// The safe state is repeated so often where no time-out of the echo is configured.
constexpr double kSafeRepeat_s = 0.5;

}  // namespace

MotorCommand::MotorCommand(const config::CommandSettings& settings)
    : settings_(settings), safe_{settings.safe_rpm, settings.safe_fins_deg}, rate_(settings.max_orders_Hz),
      shaper_(settings) {
  shaper_.jump(0, safe_);
}

std::string MotorCommand::problem_with(const LeaseRequest& request) const {
  if (request.holder.empty() || request.holder.size() > kMaxHolderLength)
    return fmt::format("holder is a name of 1 to {} bytes", kMaxHolderLength);
  if (request.priority < 0 || request.priority > kMaxPriority)
    return fmt::format("priority is 0 to {}", kMaxPriority);
  const bool fits = request.timeout_s >= settings_.min_timeout_s && request.timeout_s <= settings_.max_timeout_s;
  if (!fits) return fmt::format("timeout_s is {} to {}", settings_.min_timeout_s, settings_.max_timeout_s);
  return {};
}

std::string MotorCommand::lease(std::int64_t now_ns, const LeaseRequest& request, std::string token,
                                std::uint64_t client) {
  if (stopping_) return "navcald stops";
  if (auto problem = problem_with(request); !problem.empty()) return problem;
  if (!leak_.empty() && request.priority < settings_.operator_priority)
    return fmt::format("{} stands: only an operator (priority {} or more) may take charge", leak_,
                       settings_.operator_priority);
  const auto before = holder();
  if (auto refusal = desk_.grant(now_ns, request, std::move(token), client); !refusal.empty()) return refusal;
  const bool takes_over = before && before->client != client;
  // The new holder must not suffer from what the one before has used up.
  if (takes_over) rate_.refill();
  events_.push_back({takes_over ? "warning" : "info", "motor.lease",
                     fmt::format("{} is in charge{}, time-out {} s", words_for(*holder()),
                                 takes_over ? " instead of " + words_for(*before) : "", request.timeout_s)});
  return {};
}

std::string MotorCommand::order(std::int64_t now_ns, std::int64_t sent_ns, std::string_view token,
                                const Order& order) {
  // A late order must find its lease expired, even when no other call has looked at the time since.
  if (holder() && now_ns >= holder()->expires_ns)
    end_lease(now_ns, fmt::format("the lease expired: no order came for {} s", holder()->timeout_s));
  if (auto problem = desk_.problem_with(token); !problem.empty()) return problem;
  if (auto problem = beyond_limits(order, settings_); !problem.empty()) return problem;
  if (!port_open_) return "the motor card is away: " + away_;
  if (!rate_.take(now_ns)) return fmt::format("more than {} orders a second", settings_.max_orders_Hz);
  desk_.renew(sent_ns);
  obeyed_until_ns_ = holder()->expires_ns;
  ++sequence_;
  following_ = order_due_ = true;
  safe_due_ns_ = kNever_ns;
  shaper_.aim(order);
  return {};
}

std::string MotorCommand::release(std::int64_t now_ns, std::string_view token) {
  if (auto problem = desk_.problem_with(token); !problem.empty()) return problem;
  end_lease(now_ns, "the lease was released");
  return {};
}

std::string MotorCommand::stop(std::int64_t now_ns, std::string_view by) {
  const std::string reason = fmt::format("stopped by {}", by);
  desk_.end(reason);
  make_safe(now_ns, reason);
  return port_open_ ? std::string() : "the motor card is away, and gets the safe state when it is back: " + away_;
}

void MotorCommand::client_gone(std::int64_t now_ns, std::uint64_t client, std::string reason) {
  if (holder() && holder()->client == client) end_lease(now_ns, std::move(reason));
}

void MotorCommand::shut_down(std::int64_t now_ns) {
  stopping_ = true;
  if (holder()) {
    end_lease(now_ns, "navcald stops");
  } else if (commanded_) {
    safe_due_ns_ = now_ns;
  }
}

void MotorCommand::port_opened(std::int64_t now_ns) {
  port_open_ = true;
  if (!following_ && commanded_) make_safe(now_ns, "the port is open again");
}

void MotorCommand::port_lost(std::string reason) {
  port_open_ = false;
  order_due_ = false;
  away_ = std::move(reason);
}

void MotorCommand::commanded_before(std::int64_t now_ns) {
  commanded_ = true;
  if (port_open_) make_safe(now_ns, "an earlier run left the card with an order");
}

void MotorCommand::safe_echoed() {
  if (following_) return;
  commanded_ = false;
  safe_due_ns_ = kNever_ns;
}

void MotorCommand::shown(std::int64_t now_ns, double rpm) {
  const bool was_safe = !following_ && !commanded_ && last_line_;
  if (was_safe && std::lround(rpm) != std::lround(safe_.shaft_rpm))
    make_safe(now_ns, fmt::format("the card shows {} rpm after the safe state", rpm));
}

void MotorCommand::leak(std::int64_t now_ns, std::string leak) {
  if (settings_.on_leak == config::OnLeak::alarm) return;
  leak_ = std::move(leak);
  if (leak_.empty()) return;
  if (!holder()) return events_.push_back({"warning", "motor.leak", leak_ + ": nobody is in charge"});
  const std::string who = words_for(*holder());
  if (holder()->priority >= settings_.operator_priority)
    return events_.push_back({"warning", "motor.leak", fmt::format("{}: {} stays in charge", leak_, who)});
  events_.push_back({"warning", "motor.leak", fmt::format("{}: the lease of {} ends", leak_, who)});
  end_lease(now_ns, "the vehicle has a leak: " + leak_);
}

void MotorCommand::end_lease(std::int64_t now_ns, std::string reason) {
  const std::string who = words_for(*holder());
  desk_.end(reason);
  // The card has the safe state already, or it is being repeated: leases that come and go fill no line.
  const bool is_safe = !following_ && last_line_ && last_line_->source == Source::safe;
  if (is_safe) return events_.push_back({"info", "motor.lease", fmt::format("{}: {}", who, reason)});
  make_safe(now_ns, fmt::format("{}: {}", who, reason));
}

void MotorCommand::make_safe(std::int64_t now_ns, std::string_view why) {
  following_ = order_due_ = false;
  commanded_ = true;
  safe_due_ns_ = now_ns;
  events_.push_back({"warning", "motor.safe", fmt::format("{}; the safe state is ordered", why)});
}

Line MotorCommand::sent(const Order& order, Source source) {
  last_line_ = Line{rounded_for_card(order), source};
  return *last_line_;
}

std::optional<Line> MotorCommand::next(std::int64_t now_ns) {
  if (holder() && now_ns >= holder()->expires_ns)
    end_lease(now_ns, fmt::format("the lease expired: no order came for {} s", holder()->timeout_s));
  if (following_ && now_ns >= obeyed_until_ns_) make_safe(now_ns, "no order was taken under the new lease");
  if (!port_open_) return std::nullopt;
  if (now_ns >= safe_due_ns_) {
    const double repeat_s = settings_.echo_timeout_s > 0 ? settings_.echo_timeout_s : kSafeRepeat_s;
    safe_due_ns_ = now_ns + static_cast<std::int64_t>(std::llround(repeat_s * 1e9));
    shaper_.jump(now_ns, safe_);
    return sent(safe_, Source::safe);
  }
  if (!following_ || (!order_due_ && now_ns < shaper_.next_ns())) return std::nullopt;
  commanded_ = true;
  const Source source = std::exchange(order_due_, false) ? Source::order : Source::ramp;
  return sent(shaper_.step(now_ns), source);
}

std::int64_t MotorCommand::deadline_ns() const {
  std::int64_t deadline_ns = holder() ? holder()->expires_ns : kNever_ns;
  if (following_) deadline_ns = std::min(deadline_ns, obeyed_until_ns_);
  if (!port_open_) return deadline_ns;
  deadline_ns = std::min(deadline_ns, safe_due_ns_);
  if (following_) deadline_ns = std::min(deadline_ns, order_due_ ? 0 : shaper_.next_ns());
  return deadline_ns;
}

}  // namespace navcal::control
