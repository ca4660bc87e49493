// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "link/command.h"
#include "link/session.h"

namespace navcal::link {

/// The vehicle's end of the link (docs/remote.md). It sends reports to whoever listens, and has one operator at a
/// time: whoever proved last to have the key. Who owns one calls advance() after it was given bytes.
class Vehicle final : public End {
 public:
  static constexpr std::int64_t kReport_ns = 500'000'000;
  /// Answers that wait beyond this make further requests wait.
  static constexpr std::size_t kWaitingAnswers = 65'536;

  enum class Peer : std::uint8_t { none, alive, dead };
  struct Event {
    enum class Kind : std::uint8_t {
      came,      ///< an operator has a session
      silent,    ///< nothing was heard for dead_s
      returned,  ///< and then something was
      left,      ///< the operator said goodbye, or another one came
    };
    Kind kind = Kind::came;
    std::uint64_t session = 0;  ///< 1, 2, 3 ...
  };

  explicit Vehicle(EndOptions options) : End(std::move(options)) {}

  void advance(std::int64_t now_ns);
  [[nodiscard]] std::vector<Event> take_events() { return std::exchange(events_, {}); }

  /// The newest command that has not been taken; it is to be answered with its number.
  [[nodiscard]] std::optional<Command> take_command() { return std::exchange(command_, std::nullopt); }
  void answer(const CommandAnswer& answer);
  /// The next request of the reliable stream; each is to be answered by respond(), in their order.
  [[nodiscard]] std::optional<std::string> take_request();
  /// False: the response is too long for the link, and was not sent.
  [[nodiscard]] bool respond(std::string_view response);

  [[nodiscard]] bool is_report_due(std::int64_t now_ns) const { return now_ns >= report_due_ns_; }
  /// The newest report; one that has not been sent is given up.
  void report(std::int64_t now_ns, Buffer payload);

  /// deadline_ns() is also that of advance().
  [[nodiscard]] std::optional<Buffer> next(std::int64_t now_ns) override;

  [[nodiscard]] Peer peer() const { return peer_; }
  /// Number of the operator's session; 0: none yet.
  [[nodiscard]] std::uint64_t session() const { return sessions_; }
  /// Share of the operator's last frames that was lost.
  [[nodiscard]] double loss() const { return active_ ? active_->arrivals.loss() : 0; }

 private:
  void take_frame(std::int64_t now_ns, const FrameView& view) override;
  void take_hello(std::int64_t now_ns, const FrameView& view);
  [[nodiscard]] std::unique_ptr<Session> new_session(const Nonce& host) const;
  /// The session of a frame, once the frame has proved to belong to it; null: refused.
  [[nodiscard]] Session* admit(std::int64_t now_ns, const FrameView& view);
  void take_from_operator(std::int64_t now_ns, const FrameView& view);
  void take_command_frame(Bytes payload);
  void activate();
  void end_session();
  void refuse(std::int64_t now_ns, const FrameView& view, Refusal why);
  [[nodiscard]] std::optional<Buffer> next_of_session(std::int64_t now_ns);
  [[nodiscard]] Buffer welcome(const Session& session) const;

  std::unique_ptr<Session> active_, pending_;
  Peer peer_ = Peer::none;
  std::uint64_t sessions_ = 0;
  std::vector<Event> events_;
  std::optional<Command> command_;
  std::optional<std::uint16_t> last_command_;  ///< number
  std::optional<CommandAnswer> last_answer_;
  bool answer_due_ = false;
  Session* welcome_ = nullptr;  ///< active_ or pending_
  struct RefusalDue {
    Refusal why = Refusal::none;
    std::uint16_t session = 0;
  };
  std::optional<RefusalDue> refusal_;
  std::int64_t refusal_allowed_ns_ = 0;
  std::optional<Buffer> pong_;
  std::optional<Buffer> report_;
  std::int64_t report_due_ns_ = 0;
};

}  // namespace navcal::link
