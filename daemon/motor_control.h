// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/asio/any_io_executor.hpp>
#include <cstdint>
#include <filesystem>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "config/settings.h"
#include "control/echo_watch.h"
#include "control/motor_command.h"
#include "control/order_rate.h"
#include "daemon/control_request.h"
#include "daemon/lazy_timer.h"
#include "daemon/log_writer.h"
#include "daemon/port_session.h"
#include "daemon/state_file.h"
#include "pipeline/pipeline.h"

namespace navcal::daemon {

/// The motor card of a configuration: that of the role shaft, where several could serve; nullopt: orders are not
/// taken.
[[nodiscard]] std::optional<std::uint16_t> motor_port(const config::Settings& settings);

/// Told by MotorControl what happens.
class MotorOwner {
 public:
  virtual ~MotorOwner() = default;
  virtual void on_motor_event(std::int64_t now_ns, std::string_view severity, std::string_view name,
                              std::string_view message) = 0;
  /// The card shows no orders any more, or does again.
  virtual void on_motor_deaf(std::int64_t now_ns, bool is_deaf) = 0;
  /// No order is taken, because the next start would not know of it; or orders are taken again.
  virtual void on_motor_unnoted(std::int64_t now_ns, bool is_unnoted) = 0;
};

/// Orders of controllers to the motor card (docs/control.md): between the control socket, the card's port, log and
/// reports. The rules are control::MotorCommand's.
class MotorControl {
 public:
  /// `session` is the card's; all live longer. `second_note`: where it is noted beside the log folder that the
  /// card has an order (motor_note.h); may be empty.
  MotorControl(const boost::asio::any_io_executor& executor, const config::Settings& settings,
               const std::filesystem::path& second_note, PortSession& session, LogWriter& log,
               const pipeline::Pipeline& pipeline, MotorOwner& owner);

  /// A motor.* command; its answer, newline included.
  [[nodiscard]] ControlAnswer answer(const ControlRequest& request, const ControlOrigin& origin);
  void client_gone(std::uint64_t client, std::string reason);
  /// A leak was raised, or (empty) none stands any more.
  void leak(std::int64_t now_ns, std::string leak);
  /// Why the card must keep its power now; empty: it may be switched off.
  [[nodiscard]] std::string why_power_stays() const;
  /// The card's port came or went.
  void port_changed(std::int64_t now_ns);
  /// A status of the card.
  void status(const instruments::Stamp& stamp, const instruments::MotorSample& motor);
  /// No lease any more, and the safe state if the card has another order: repeated until is_safe() or stop().
  void begin_stop();
  /// The card has shown the safe state, or has no order.
  [[nodiscard]] bool is_safe() const { return !command_.is_card_commanded(); }
  void stop();
  /// Notices since the last call, for people.
  [[nodiscard]] std::vector<std::string> take_notices();

  [[nodiscard]] const control::MotorCommand& command() const { return command_; }
  /// Delay of the last order after the STATE that it answers, seconds.
  [[nodiscard]] std::optional<double> late_s() const { return late_s_; }
  /// "motor" of HEALTH, an object of JSON.
  [[nodiscard]] std::string health(std::int64_t now_ns) const;

 private:
  [[nodiscard]] ControlAnswer answer_lease(const ControlRequest& request, const ControlOrigin& origin);
  /// `problem`: why the next start would not know that the card has an order; empty: it would.
  /// A stop since then (`stops` of stops_) ends a lease that was asked for before.
  [[nodiscard]] std::string grant(const control::LeaseRequest& request, std::uint64_t client, std::uint64_t stops,
                                  std::string problem);
  [[nodiscard]] ControlAnswer answer_stop(const ControlRequest& request, const ControlOrigin& origin);
  [[nodiscard]] std::string answer_order(const ControlRequest& request, const ControlOrigin& origin);
  /// A record with the number of the last order and who is in charge.
  [[nodiscard]] control::OrderRecord record_of_holder() const;
  [[nodiscard]] std::string refuse(const ControlRequest& request, const ControlOrigin& origin, std::string reason);
  /// Sends what is due. The time at which the last line was on the wire; nullopt: none was.
  std::optional<std::int64_t> drive(std::int64_t now_ns);
  std::optional<std::int64_t> send(const control::Line& line, std::int64_t now_ns);
  void ring();
  /// Logs and counts records that came since.
  void take_records(std::int64_t now_ns);
  void tell(std::int64_t now_ns);

  PortSession& session_;
  LogWriter& log_;
  const pipeline::Pipeline& pipeline_;
  MotorOwner& owner_;
  control::MotorCommand command_;
  control::EchoWatch echo_;
  control::OrderRate refusals_, events_;                    ///< of records and events: a flood fills no log
  const std::shared_ptr<const std::string> configuration_;  ///< what the notes contain
  const std::vector<std::shared_ptr<StateFile>> notes_;     ///< the first must be kept, another may be
  bool is_noted_ = false;                                   ///< they are, or are being made
  LazyTimer timer_;
  std::vector<control::OrderRecord> records_;
  std::int64_t asked_ns_ = 0;  ///< arrival of the last order
  std::optional<double> late_s_;
  std::string refusal_;
  std::optional<double> echo_s_;
  std::uint64_t refused_ = 0, refused_since_ = 0, events_left_out_ = 0;
  std::uint64_t sent_ = 0, echoed_ = 0, not_echoed_ = 0, superseded_ = 0;
  bool is_deaf_ = false;
  bool is_unnoted_ = false;
  int leases_under_way_ = 0;  ///< the note is being made for them
  std::uint64_t stops_ = 0;
  std::vector<std::shared_ptr<std::promise<void>>> shown_;  ///< of stops that wait for the card
  bool is_open_ = false;
  bool busy_ = false;  ///< told that the line takes nothing
  bool stopped_ = false;
};

}  // namespace navcal::daemon
