// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "link/stream.h"

namespace navcal::link {
namespace {

constexpr double kFirstTimeout_s = 1.5;
constexpr double kShortestTimeout_s = 0.3;
constexpr double kLongestTimeout_s = 6;
/// Beyond the round trip: the other end may wait so long before it acknowledges.
constexpr double kAckWait_s = 0.15;
/// A segment is lost when one that was sent so many sendings later has come (RFC 8985 reckons in the same way).
constexpr std::uint64_t kReordering = 3;
/// So many time-outs without any acknowledgement: the link is taken for dead, and one segment at a time is tried.
constexpr unsigned kSilent = 4;

/// RFC 6298: weights of a new measurement of the round trip and of its spread.
constexpr double kMeanWeight = 0.125;
constexpr double kSpreadWeight = 0.25;

}  // namespace

bool StreamSender::push(std::string_view message) {
  if (message.size() > kMaxMessage) return false;
  queued_bytes_ += message.size();
  do {
    const auto piece = message.substr(0, kSegmentBytes);
    message.remove_prefix(piece.size());
    Item item;
    item.data.assign(piece.begin(), piece.end());
    item.is_last = message.empty();
    items_.push_back(std::move(item));
  } while (!message.empty());
  return true;
}

std::size_t StreamSender::open_items() const {
  return std::min(items_.size(), silent_ >= kSilent ? std::size_t{1} : kWindow);
}

std::int64_t StreamSender::timeout_ns(const Item& item) const {
  double timeout_s = round_trip_s_ ? *round_trip_s_ + 4 * spread_s_ + kAckWait_s : kFirstTimeout_s;
  timeout_s = std::max(timeout_s, kShortestTimeout_s) * (item.times < 2 ? 1 : item.times < 3 ? 1.5 : 2);
  return static_cast<std::int64_t>(std::min(timeout_s, kLongestTimeout_s) * 1e9);
}

std::optional<Buffer> StreamSender::due(std::int64_t now_ns) {
  for (std::size_t i = 0; i < open_items(); ++i) {
    const Item& item = items_[i];
    if (item.is_acknowledged) continue;
    if (item.times > 0 && !item.is_lost && now_ns < item.sent_ns + timeout_ns(item)) continue;
    next_ = i;
    return encode_segment({static_cast<std::uint16_t>(first_ + i), item.is_last, item.data});
  }
  return std::nullopt;
}

void StreamSender::sent(std::int64_t now_ns, std::uint32_t counter) {
  Item& item = items_[next_];
  if (next_ == 0 && item.times > 0 && !item.is_lost) ++silent_;
  ++item.times;
  item.is_lost = false;
  item.sent_ns = now_ns;
  item.order = ++order_;
  sendings_[order_ % sendings_.size()] = {counter, now_ns, order_};
}

bool StreamSender::is_acknowledged_by(const Ack& ack, std::size_t index) const {
  const auto ahead = static_cast<std::int16_t>(first_ + index - ack.next);
  return ahead < 0 || (ahead > 0 && ahead <= static_cast<int>(kWindow) && (ack.others >> (ahead - 1) & 1U) != 0);
}

void StreamSender::acknowledge(std::int64_t now_ns, const Ack& ack) {
  // An acknowledgement of segments that were never sent belongs to no state of this end.
  const auto ahead = static_cast<std::int16_t>(ack.next - first_);
  if (ahead > static_cast<int>(std::min(items_.size(), kWindow))) return;
  bool is_new = false;
  for (std::size_t i = 0; i < std::min(items_.size(), kWindow); ++i) {
    Item& item = items_[i];
    if (item.is_acknowledged || item.times == 0 || !is_acknowledged_by(ack, i)) continue;
    item.is_acknowledged = is_new = true;
    queued_bytes_ -= item.data.size();
  }
  if (is_new) silent_ = 0;
  learn(now_ns, ack);
  while (!items_.empty() && items_.front().is_acknowledged) {
    items_.pop_front();
    ++first_;
  }
}

void StreamSender::learn(std::int64_t now_ns, const Ack& ack) {
  const auto sending =
      std::ranges::find_if(sendings_, [&](const Sending& s) { return s.order != 0 && s.counter == ack.counter; });
  if (sending == sendings_.end()) return;
  const double trip_s = std::max(0.0, static_cast<double>(now_ns - sending->sent_ns) * 1e-9 - ack.held_ms * 1e-3);
  if (round_trip_s_) {
    spread_s_ += kSpreadWeight * (std::abs(trip_s - *round_trip_s_) - spread_s_);
    *round_trip_s_ += kMeanWeight * (trip_s - *round_trip_s_);
  } else {
    round_trip_s_ = trip_s;
    spread_s_ = trip_s / 2;
  }
  for (std::size_t i = 0; i < std::min(items_.size(), kWindow); ++i) {
    Item& item = items_[i];
    if (!item.is_acknowledged && item.times > 0 && item.order + kReordering <= sending->order) item.is_lost = true;
  }
}

std::int64_t StreamSender::deadline_ns() const {
  std::int64_t deadline_ns = kNoDeadline;
  for (std::size_t i = 0; i < open_items(); ++i) {
    const Item& item = items_[i];
    if (item.is_acknowledged) continue;
    if (item.times == 0 || item.is_lost) return 0;
    deadline_ns = std::min(deadline_ns, item.sent_ns + timeout_ns(item));
  }
  return deadline_ns;
}

}  // namespace navcal::link
