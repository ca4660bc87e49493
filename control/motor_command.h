// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "control/lease_desk.h"
#include "control/order.h"
#include "control/order_rate.h"
#include "control/shaper.h"

namespace navcal::control {

/// Decides what is sent to the motor card, and when (docs/control.md): leases, limits, rate, slew, and the safe
/// state when nobody is in charge. Who owns one asks next() after every call, and again at deadline_ns(), until it
/// has no line left.
///
/// Assumption: a card obeys the last line that reached it until the next one comes. So a vehicle without a holder
/// is safe only after the safe state was sent, and the safe state is sent again until a status has shown it.
class MotorCommand {
 public:
  /// An event for people.
  struct Event {
    std::string_view severity;  ///< "info" or "warning"
    std::string_view name;      ///< "motor.lease", "motor.safe", "motor.leak"
    std::string message;
  };

  explicit MotorCommand(const config::CommandSettings& settings);

  /// lease(), order() and release() return why they refuse; empty: done. `client` is the connection that asks.
  [[nodiscard]] std::string lease(std::int64_t now_ns, const LeaseRequest& request, std::string token,
                                  std::uint64_t client);
  /// The lease is renewed from `sent_ns` on, the earliest time at which the order may have been sent.
  [[nodiscard]] std::string order(std::int64_t now_ns, std::int64_t sent_ns, std::string_view token,
                                  const Order& order);
  [[nodiscard]] std::string release(std::int64_t now_ns, std::string_view token);
  /// Ends every lease and orders the safe state, whoever asks. Returns why it does not go out now; empty: it does.
  [[nodiscard]] std::string stop(std::int64_t now_ns, std::string_view by);

  /// A lease of this connection ends; `reason` is what its next order hears.
  void client_gone(std::int64_t now_ns, std::uint64_t client, std::string reason);
  /// The program ends: no lease any more, and the safe state is due if the card has another order.
  void shut_down(std::int64_t now_ns);
  void port_opened(std::int64_t now_ns);
  void port_lost(std::string reason);
  /// An earlier run of the program left the card with an order.
  void commanded_before(std::int64_t now_ns);
  /// A status has shown the safe state.
  void safe_echoed();
  /// A status shows this shaft speed: when the safe state was shown before, one that is not safe is undone.
  void shown(std::int64_t now_ns, double rpm);
  /// `leak` names an alarm that was raised; empty: no leak stands any more. With on_leak "safe", the lease of a
  /// program ends, and until the leak is over only an operator gets one.
  void leak(std::int64_t now_ns, std::string leak);

  /// Ends a lease whose time is over. Returns the line to be sent now, if any; it counts as sent.
  [[nodiscard]] std::optional<Line> next(std::int64_t now_ns);
  [[nodiscard]] std::int64_t deadline_ns() const;

  [[nodiscard]] const std::optional<Holder>& holder() const { return desk_.holder(); }
  [[nodiscard]] const Order& wanted() const { return shaper_.wanted(); }
  /// Line that the card was sent last; nullopt when this run has sent none.
  [[nodiscard]] const std::optional<Line>& last_line() const { return last_line_; }
  /// True while the shaper has not reached the last order.
  [[nodiscard]] bool is_shaping() const { return !shaper_.arrived(); }
  /// Number of the last order taken; 0: none.
  [[nodiscard]] std::uint64_t sequence() const { return sequence_; }
  /// True when the card may obey an order other than the safe state.
  [[nodiscard]] bool is_card_commanded() const { return commanded_; }
  [[nodiscard]] std::vector<Event> take_events() { return std::exchange(events_, {}); }

 private:
  [[nodiscard]] std::string problem_with(const LeaseRequest& request) const;
  void end_lease(std::int64_t now_ns, std::string reason);
  void make_safe(std::int64_t now_ns, std::string_view why);
  [[nodiscard]] Line sent(const Order& order, Source source);

  config::CommandSettings settings_;
  Order safe_;
  LeaseDesk desk_;
  OrderRate rate_;
  Shaper shaper_;
  std::optional<Line> last_line_;
  std::vector<Event> events_;
  std::uint64_t sequence_ = 0;
  std::int64_t safe_due_ns_ = kNever_ns;  ///< when the safe state is to be sent (again)
  std::int64_t obeyed_until_ns_ = 0;      ///< the order taken last holds no longer, whoever has got a lease since
  bool order_due_ = false;
  bool following_ = false;  ///< an order, not the safe state
  bool commanded_ = false;
  bool port_open_ = false;
  bool stopping_ = false;
  std::string away_ = "not opened yet";
  std::string leak_;  ///< the alarm that was raised last; empty: none stands, or leaks are alarms only
};

}  // namespace navcal::control
