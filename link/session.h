// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>

#include "link/arrivals.h"
#include "link/budget.h"
#include "link/frame.h"
#include "link/key.h"
#include "link/stream.h"

namespace navcal::link {

/// Why a frame is refused; numbers as on the wire.
enum class Refusal : std::uint8_t {
  none = 0,
  untagged = 1,         ///< the vehicle has a key, and the frame has no tag
  bad_tag = 2,          ///< the tag is of another key
  no_key = 3,           ///< the frame has a tag, and the vehicle has no key to check it
  unknown_session = 4,  ///< the session is over, or of an earlier run of the vehicle's program
};
/// For people.
[[nodiscard]] std::string_view words_for(Refusal refusal);

/// Settings of an end of the link.
struct EndOptions {
  std::optional<Key> key;
  double budget_B_s = 2000;  ///< sent at most, in the mean
  double dead_s = 5;         ///< silence after which the link counts as dead
  std::function<Nonce()> nonce = random_nonce;
};

/// What an end counts.
struct EndCounters {
  std::uint64_t frames = 0;    ///< intact ones of the other end that were taken
  std::uint64_t refused = 0;   ///< without the right tag or session
  std::uint64_t repeated = 0;  ///< came before, or too late
  std::uint64_t sent_bytes = 0;
};

/// Longest request that a vehicle takes: a line of the control socket.
inline constexpr std::size_t kLongestRequest = 4096;

/// One session as one of its ends sees it.
class Session {
 public:
  Session(std::uint16_t id, const Nonce& vehicle, const Nonce& host, const std::optional<Key>& key,
          Direction outgoing);

  /// The next frame; counts it.
  [[nodiscard]] Buffer frame(FrameType type, Bytes payload);
  /// Whether a frame has this session's tag, or needs none.
  [[nodiscard]] Refusal check(const FrameView& view) const;
  [[nodiscard]] std::uint32_t last_counter() const { return counter_; }

  const std::uint16_t id;
  const Nonce vehicle, host;
  Arrivals arrivals;
  StreamSender sender;
  StreamReceiver receiver;

 private:
  std::optional<SessionKey> key_;
  Direction outgoing_;
  std::uint32_t counter_ = 0;
};

/// Length of a frame with such a payload.
[[nodiscard]] constexpr std::size_t frame_length(std::size_t payload, bool is_tagged) {
  return kHeaderLength + payload + (is_tagged ? kTagLength : 0) + kCrcLength;
}

/// An end of the link. Whoever owns one gives it bytes, takes what has come, and sends what next() gives until
/// that is nothing; and again at deadline_ns().
class End {
 public:
  virtual ~End() = default;
  End(End&&) = default;
  End& operator=(End&&) = default;

  void take(std::int64_t now_ns, Bytes bytes);
  /// The next frame for the line; it counts as sent.
  [[nodiscard]] virtual std::optional<Buffer> next(std::int64_t now_ns) = 0;
  /// When next() may have something to do; right after next() gave nothing.
  [[nodiscard]] std::int64_t deadline_ns() const { return wake_ns_; }
  [[nodiscard]] const EndCounters& counters() const { return counters_; }
  [[nodiscard]] const protocols::Counters& line() const { return parser_.counters(); }

 protected:
  explicit End(EndOptions options);
  virtual void take_frame(std::int64_t now_ns, const FrameView& view) = 0;
  /// Segments and acknowledgements of a session.
  static void take_of_stream(std::int64_t now_ns, const FrameView& view, Session& session);

  /// Whether the budget lets a frame pass; else it wakes once it does.
  [[nodiscard]] bool allows(std::int64_t now_ns, std::size_t length, bool is_urgent);
  [[nodiscard]] bool passes(std::int64_t now_ns, std::size_t payload, bool is_urgent = false) {
    return allows(now_ns, frame_length(payload, options_.key.has_value()), is_urgent);
  }
  [[nodiscard]] Buffer counted(Buffer frame);
  [[nodiscard]] std::optional<Buffer> next_of_stream(std::int64_t now_ns, Session& session, bool is_heard = true);
  void wake(std::int64_t time_ns) { wake_ns_ = std::min(wake_ns_, time_ns); }

  EndOptions options_;
  std::optional<SessionKey> outside_;
  std::int64_t heard_ns_ = 0;
  std::uint32_t outside_counter_ = 0;
  std::int64_t wake_ns_ = 0;
  EndCounters counters_;

 private:
  Parser parser_;
  Budget budget_;
};

/// A frame made with a key, or with none: outside sessions.
[[nodiscard]] Buffer make_frame(Header header, Bytes payload, const std::optional<SessionKey>& key,
                                Direction direction);

}  // namespace navcal::link
