// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "link/frame.h"

/// Messages of any length over frames that get lost: cut into numbered segments, acknowledged one by one, sent
/// again. Each message arrives once and in order.
namespace navcal::link {

inline constexpr std::size_t kSegmentBytes = 180;
inline constexpr std::size_t kWindow = 32;           ///< segments on their way
inline constexpr std::size_t kMaxMessage = 262'144;  ///< longer ones are not taken
inline constexpr std::int64_t kNoDeadline = INT64_MAX;

/// Payload of SEGMENT.
struct Segment {
  std::uint16_t number = 0;
  bool is_last = false;  ///< of its message
  Bytes data;
};
[[nodiscard]] Buffer encode_segment(const Segment& segment);
[[nodiscard]] std::optional<Segment> decode_segment(Bytes payload);

/// Payload of ACK.
struct Ack {
  std::uint16_t next = 0;     ///< all segments before this one have come
  std::uint32_t others = 0;   ///< bit n: segment next + 1 + n has come too
  std::uint32_t counter = 0;  ///< of the frame with the newest segment: from it the sender knows the way's time
  std::uint16_t held_ms = 0;  ///< time between the arrival of that frame and this acknowledgement
};
[[nodiscard]] Buffer encode_ack(const Ack& ack);
[[nodiscard]] std::optional<Ack> decode_ack(Bytes payload);

class StreamSender {
 public:
  /// False: longer than kMaxMessage.
  [[nodiscard]] bool push(std::string_view message);
  /// Bytes that have not been acknowledged.
  [[nodiscard]] std::size_t queued_bytes() const { return queued_bytes_; }

  /// Payload that is due, new or again; it stays due until sent() is called.
  [[nodiscard]] std::optional<Buffer> due(std::int64_t now_ns);
  /// What due() gave has gone out in the frame with this counter.
  void sent(std::int64_t now_ns, std::uint32_t counter);
  void acknowledge(std::int64_t now_ns, const Ack& ack);
  /// When something becomes due by itself.
  [[nodiscard]] std::int64_t deadline_ns() const;
  /// Mean time there and back; nullopt before the first acknowledgement.
  [[nodiscard]] std::optional<double> round_trip_s() const { return round_trip_s_; }

 private:
  struct Item {
    Buffer data;
    bool is_last = false;
    bool is_acknowledged = false;
    bool is_lost = false;
    unsigned times = 0;        ///< sent so often
    std::int64_t sent_ns = 0;  ///< the last time
    std::uint64_t order = 0;   ///< of the last time among all sendings
  };
  struct Sending {
    std::uint32_t counter = 0;
    std::int64_t sent_ns = 0;
    std::uint64_t order = 0;
  };
  [[nodiscard]] std::size_t open_items() const;
  [[nodiscard]] std::int64_t timeout_ns(const Item& item) const;
  void learn(std::int64_t now_ns, const Ack& ack);
  [[nodiscard]] bool is_acknowledged_by(const Ack& ack, std::size_t index) const;

  std::deque<Item> items_;
  std::uint16_t first_ = 0;  ///< number of the first item
  std::size_t queued_bytes_ = 0;
  std::size_t next_ = 0;  ///< item that due() gave
  std::uint64_t order_ = 0;
  std::array<Sending, 64> sendings_{};  ///< the newest
  std::optional<double> round_trip_s_;
  double spread_s_ = 0;
  unsigned silent_ =
      0;  ///< time-outs of the first item since an acknowledgement: on a dead link it alone is tried
};

class StreamReceiver {
 public:
  /// Longer messages are dropped as a whole.
  explicit StreamReceiver(std::size_t longest = kMaxMessage) : longest_(longest) {}

  void take(std::int64_t now_ns, const Segment& segment, std::uint32_t counter);
  /// The next whole message.
  [[nodiscard]] std::optional<std::string> pop();

  /// When an acknowledgement is to be sent; kNoDeadline: nothing is to be acknowledged.
  [[nodiscard]] std::int64_t ack_due_ns() const { return ack_due_ns_; }
  /// The acknowledgement; it counts as sent.
  [[nodiscard]] Ack ack(std::int64_t now_ns);
  [[nodiscard]] std::uint64_t dropped() const { return dropped_; }
  [[nodiscard]] std::uint64_t bytes() const { return bytes_; }

 private:
  struct Held {
    Buffer data;
    bool is_last = false;
  };
  void append(const Held& held);

  std::size_t longest_;
  std::uint16_t next_ = 0;
  std::map<std::size_t, Held> held_;  ///< by distance from next_, 1 to kWindow
  std::string message_;
  bool is_too_long_ = false;
  std::deque<std::string> messages_;
  std::int64_t ack_due_ns_ = kNoDeadline;
  unsigned unacknowledged_ = 0;
  std::uint32_t counter_ = 0;
  std::int64_t arrival_ns_ = 0;
  std::uint64_t dropped_ = 0;
  std::uint64_t bytes_ = 0;  ///< of whole messages
};

}  // namespace navcal::link
