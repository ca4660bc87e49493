// SPDX-License-Identifier: Apache-2.0
#include "control/echo_watch.h"

#include <cmath>
#include <utility>

namespace navcal::control {
namespace {

/// The longest time-out at the highest rate of the configuration; without a time-out the last second counts.
constexpr std::size_t kMostTimed = 2048;
constexpr std::size_t kMostUntimed = 64;

}  // namespace

EchoWatch::EchoWatch(double timeout_s, std::int64_t transit_ns)
    : timeout_ns_(std::llround(timeout_s * 1e9)), transit_ns_(transit_ns),
      capacity_(timeout_ns_ > 0 ? kMostTimed : kMostUntimed) {}

void EchoWatch::pass_on_first(Outcome outcome, std::vector<OrderRecord>& out) {
  out.push_back(std::move(waiting_.front()));
  out.back().outcome = outcome;
  waiting_.pop_front();
}

void EchoWatch::sent(OrderRecord record, std::vector<OrderRecord>& out) {
  if (waiting_.size() == capacity_) pass_on_first(Outcome::superseded, out);
  waiting_.push_back(std::move(record));
}

void EchoWatch::status(std::int64_t validity_ns, std::int64_t arrival_ns,
                       const std::optional<double>& rpm_commanded, std::vector<OrderRecord>& out) {
  if (!rpm_commanded) return;
  const long rpm = std::lround(*rpm_commanded);
  std::size_t place = waiting_.size();
  while (place > 0) {
    const OrderRecord& line = waiting_[place - 1];
    if (*line.sent_ns + transit_ns_ <= validity_ns && line.sent->rpm == rpm) break;
    --place;
  }
  if (place == 0) return;
  for (; place > 1; --place) pass_on_first(Outcome::superseded, out);
  waiting_.front().echoed_ns = arrival_ns;
  pass_on_first(Outcome::echoed, out);
  deaf_ = false;
}

void EchoWatch::update(std::int64_t now_ns, std::vector<OrderRecord>& out) {
  while (now_ns >= deadline_ns()) {
    pass_on_first(Outcome::not_echoed, out);
    deaf_ = true;
  }
}

void EchoWatch::give_up(std::vector<OrderRecord>& out) {
  while (!waiting_.empty()) pass_on_first(Outcome::not_echoed, out);
}

std::int64_t EchoWatch::deadline_ns() const {
  return timeout_ns_ == 0 || waiting_.empty() ? kNever_ns : *waiting_.front().sent_ns + timeout_ns_;
}

}  // namespace navcal::control
