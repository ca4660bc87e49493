// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <utility>

#include "link/stream.h"

namespace navcal::link {
namespace {

constexpr std::int64_t kAckWait_ns = 100'000'000;
/// So many segments are acknowledged together.
constexpr unsigned kTogether = 4;
/// Whole messages that wait to be popped; further segments are not taken, and the sender tries again later.
constexpr std::size_t kMessages = 8;

}  // namespace

void StreamReceiver::take(std::int64_t now_ns, const Segment& segment, std::uint32_t counter) {
  const auto ahead = static_cast<std::int16_t>(segment.number - next_);
  if (ahead > static_cast<int>(kWindow)) return;
  if (ahead >= 0 && messages_.size() >= kMessages) return;
  counter_ = counter;
  arrival_ns_ = now_ns;
  ++unacknowledged_;
  bool is_urgent = ahead != 0;  // a gap, or an acknowledgement that was lost
  if (ahead == 0) {
    append({Buffer(segment.data.begin(), segment.data.end()), segment.is_last});
    is_urgent = segment.is_last;
  } else if (ahead > 0) {
    held_.try_emplace(static_cast<std::size_t>(ahead),
                      Held{Buffer(segment.data.begin(), segment.data.end()), segment.is_last});
  }
  const bool is_now = is_urgent || unacknowledged_ >= kTogether;
  ack_due_ns_ = std::min(ack_due_ns_, is_now ? now_ns : now_ns + kAckWait_ns);
}

void StreamReceiver::append(const Held& first) {
  const Held* held = &first;
  std::map<std::size_t, Held>::node_type node;
  for (;;) {
    if (message_.size() + held->data.size() > longest_) is_too_long_ = true;
    if (is_too_long_) {
      message_.clear();
    } else {
      message_.append(held->data.begin(), held->data.end());
    }
    if (held->is_last) {
      bytes_ += message_.size();
      if (!std::exchange(is_too_long_, false)) {
        messages_.push_back(std::exchange(message_, {}));
      } else {
        ++dropped_;
      }
    }
    ++next_;
    // The others are one nearer now.
    node = held_.extract(1);
    std::map<std::size_t, Held> nearer;
    for (auto& [distance, other] : held_) nearer.emplace(distance - 1, std::move(other));
    held_ = std::move(nearer);
    if (node.empty()) return;
    held = &node.mapped();
  }
}

std::optional<std::string> StreamReceiver::pop() {
  if (messages_.empty()) return std::nullopt;
  std::string message = std::move(messages_.front());
  messages_.pop_front();
  return message;
}

Ack StreamReceiver::ack(std::int64_t now_ns) {
  ack_due_ns_ = kNoDeadline;
  unacknowledged_ = 0;
  Ack ack;
  ack.next = next_;
  for (const auto& [distance, held] : held_) ack.others |= std::uint32_t{1} << (distance - 1);
  ack.counter = counter_;
  ack.held_ms = static_cast<std::uint16_t>(std::clamp<std::int64_t>((now_ns - arrival_ns_) / 1'000'000, 0, 65535));
  return ack;
}

}  // namespace navcal::link
