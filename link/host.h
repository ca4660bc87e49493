// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "link/command.h"
#include "link/report.h"
#include "link/session.h"

namespace navcal::link {

/// The operator's end of the link (docs/remote.md).
class Host final : public End {
 public:
  /// Frames with which a session ends: one of them should come through.
  static constexpr int kByes = 6;

  /// How good the link is.
  struct Quality {
    double loss_in = 0;   ///< of the vehicle's last 64 frames, the share that was lost
    double loss_out = 0;  ///< likewise of this end's, as the vehicle said last
    std::optional<double> round_trip_s;
    std::uint64_t stream_bytes = 0;  ///< of whole responses
  };
  struct NewReport {
    Report report;
    bool is_verified = false;  ///< its tag is right
  };

  explicit Host(EndOptions options);

  /// A command; it replaces one that has not been answered. Returns its number. nullopt: there is no session yet,
  /// or an order would replace a lease, a release or a stop under way.
  [[nodiscard]] std::optional<std::uint16_t> command(std::int64_t now_ns, Command command);
  [[nodiscard]] std::optional<CommandAnswer> take_answer() { return std::exchange(answer_, std::nullopt); }
  /// A request on the reliable stream. False: there is no session, or it is too long.
  [[nodiscard]] bool request(std::string_view line);
  [[nodiscard]] std::optional<std::string> take_response();
  /// The newest report that has not been taken.
  [[nodiscard]] std::optional<NewReport> take_report() { return std::exchange(report_, std::nullopt); }
  /// Why the vehicle refused something, since the last call. Not authenticated: for people only.
  [[nodiscard]] Refusal take_refusal() { return std::exchange(refusal_, Refusal::none); }
  /// The session ends after this in good order.
  void bye() { byes_ = kByes; }
  [[nodiscard]] bool has_said_bye() const { return byes_ == 0; }

  [[nodiscard]] std::optional<Buffer> next(std::int64_t now_ns) override;

  [[nodiscard]] bool has_session() const { return session_ != nullptr; }
  /// Sessions so far. With a new one all requests and commands under way are forgotten: nobody knows whether they
  /// were executed.
  [[nodiscard]] unsigned sessions() const { return sessions_; }
  /// Something was heard of the session within dead_s.
  [[nodiscard]] bool is_alive(std::int64_t now_ns) const;
  [[nodiscard]] Quality quality() const;

 private:
  [[nodiscard]] bool has_begun_to_leave() const { return byes_ >= 0 && byes_ < kByes; }
  struct Pending {
    Command command;
    std::int64_t due_ns = 0;    ///< when it is sent, again
    std::int64_t until_ns = 0;  ///< sent no more after this: nobody wants an old order executed
  };
  void take_frame(std::int64_t now_ns, const FrameView& view) override;
  void take_welcome(std::int64_t now_ns, const FrameView& view);
  void take_from_vehicle(std::int64_t now_ns, const FrameView& view);
  void take_stray(const FrameView& view);
  void take_pong(std::int64_t now_ns, Bytes payload);
  [[nodiscard]] std::optional<Buffer> next_hello(std::int64_t now_ns);
  [[nodiscard]] std::optional<Buffer> next_command(std::int64_t now_ns);
  [[nodiscard]] std::int64_t again_ns() const;

  std::optional<Nonce> hello_;  ///< the random number of a HELLO that has not been answered
  std::int64_t hello_due_ns_ = 0;
  std::unique_ptr<Session> session_;
  unsigned sessions_ = 0;
  std::int64_t ping_due_ns_ = 0;
  std::optional<Pending> pending_;
  std::uint16_t last_command_ = 0;
  std::optional<CommandAnswer> answer_;
  std::optional<NewReport> report_;
  std::uint32_t report_counter_ = 0;  ///< of the newest report of the session, or outside one
  std::uint16_t report_session_ = 0;
  Refusal refusal_ = Refusal::none;
  std::optional<double> round_trip_s_;
  double loss_out_ = 0;
  int byes_ = -1;
  std::int64_t bye_due_ns_ = 0;
};

}  // namespace navcal::link
