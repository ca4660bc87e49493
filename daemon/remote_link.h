// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/asio/any_io_executor.hpp>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "config/settings.h"
#include "daemon/control_request.h"
#include "daemon/lazy_timer.h"
#include "link/report.h"
#include "link/vehicle.h"
#include "ports/port.h"

namespace navcal::daemon {

/// What the remote link needs of the daemon.
class RemoteOwner {
 public:
  virtual ~RemoteOwner() = default;
  [[nodiscard]] virtual link::Report remote_report(std::int64_t now_ns) = 0;
  /// Gives `reply` the answer that the control socket would give, a line of JSON; now or later, on the I/O thread.
  using Reply = std::function<void(std::string)>;
  virtual void remote_answer(const ControlRequest& request, const ControlOrigin& origin, Reply reply) = 0;
  /// An operator is gone: its lease ends.
  virtual void remote_client_gone(std::uint64_t client) = 0;
  virtual void end_every_lease() = 0;
  /// Whether the lease of the motor is this client's.
  [[nodiscard]] virtual bool is_in_charge(std::uint64_t client) const = 0;
  virtual void on_remote_event(std::int64_t now_ns, std::string_view severity, std::string_view name,
                               std::string_view message) = 0;
  virtual void on_remote_dead(std::int64_t now_ns, bool is_dead) = 0;
};

/// The vehicle's end of the remote link at work (docs/remote.md): its line, its timer, and what operators ask for.
class RemoteLink : private ports::PortListener {
 public:
  /// Throws std::runtime_error when the key cannot be read or the address is taken.
  RemoteLink(const boost::asio::any_io_executor& executor, const config::RemoteSettings& settings,
             RemoteOwner& owner);

  void start();
  void stop();
  /// "remote" of HEALTH, an object of JSON.
  [[nodiscard]] std::string health() const;

 private:
  void on_opened(std::int64_t now_ns, const ports::OpenPort& port) override;
  void on_bytes(std::int64_t now_ns, protocols::Bytes bytes) override;
  void on_sent(std::int64_t, protocols::Bytes) override {}
  void on_lost(std::int64_t now_ns, std::string_view reason) override;
  ports::PortListener& listener() { return *this; }
  void drive(std::int64_t now_ns);
  void take_events(std::int64_t now_ns);
  void link_is_silent(std::int64_t now_ns);
  void execute(const link::Command& command, std::int64_t now_ns);
  void answer(std::string_view line, std::int64_t now_ns);
  void respond(std::string_view response);
  /// While a lease is held: bytes that are read now came after the last beat but one, since each turn of the loop
  /// reads what is there before it comes to its timers.
  void beat();
  [[nodiscard]] ControlOrigin origin(std::int64_t now_ns) const;
  /// Whether operators may change anything.
  [[nodiscard]] bool may_change() const { return has_key_ || settings_.orders_without_key; }

  const config::RemoteSettings settings_;
  RemoteOwner& owner_;
  const bool has_key_;
  link::Vehicle vehicle_;
  std::string lease_;        ///< token of the operator's lease, which does not travel
  bool is_leasing_ = false;  ///< a lease is the newest command that is no order: one that is granted is wanted
  bool is_open_ = false;
  bool is_answering_ = false;  ///< a request waits for its reply; the next one waits for that
  std::shared_ptr<char> alive_ = std::make_shared<char>();  ///< a reply may come after the end
  ports::Port line_;
  LazyTimer timer_;
  LazyTimer beat_timer_;
  std::int64_t last_beat_ns_ = 0, beat_before_ns_ = 0;
};

}  // namespace navcal::daemon
