// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/asio/any_io_executor.hpp>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "config/settings.h"
#include "daemon/control_request.h"
#include "daemon/lazy_timer.h"
#include "daemon/port_session.h"

namespace navcal::daemon {

/// The line that switches a supply. Narrow, so that a test can put its own in place of the kernel's.
class PowerLine {
 public:
  virtual ~PowerLine() = default;
  /// nullopt: the line is an input, or cannot be read.
  [[nodiscard]] virtual std::optional<bool> is_on() const = 0;
  /// Why it cannot be switched; empty: done.
  [[nodiscard]] virtual std::string set(bool on) = 0;
};

/// Takes the line of a supply and does to it what its at_start says; null and `problem` when it cannot be taken.
[[nodiscard]] std::unique_ptr<PowerLine> open_gpio_line(const config::PowerSettings& settings,
                                                        std::string& problem);

/// Told by PowerControl what happens, and asked by it.
class PowerOwner {
 public:
  virtual ~PowerOwner() = default;
  virtual void on_power_event(std::int64_t now_ns, std::string_view severity, std::string_view name,
                              std::string_view message) = 0;
  /// Why the device at this port must keep its supply now; empty: it may be switched off.
  [[nodiscard]] virtual std::string why_power_stays(std::uint16_t port) const = 0;
};

/// The supplies of [power.NAME]: switches their lines, and tells the sessions of the devices that they feed.
class PowerControl {
 public:
  using OpenLine = std::function<std::unique_ptr<PowerLine>(const config::PowerSettings&, std::string& problem)>;
  using Sessions = std::vector<std::unique_ptr<PortSession>>;

  /// `sessions` and `owner` live longer; the sessions may be made later than this, before begin().
  PowerControl(const boost::asio::any_io_executor& executor, const config::Settings& settings,
               const Sessions& sessions, PowerOwner& owner, OpenLine open = open_gpio_line);

  /// Takes the lines and does what at_start says. A line that cannot be taken is an event, and is tried again when
  /// somebody switches it.
  void begin(std::int64_t now_ns);
  void stop() { timer_.stop(); }
  /// A power.* command; its answer, newline included.
  [[nodiscard]] std::string answer(const ControlRequest& request);

 private:
  struct Supply {
    config::PowerSettings settings;
    std::vector<std::uint16_t> ports;
    std::unique_ptr<PowerLine> line;
    std::string problem;                        ///< why the line could not be taken or switched
    std::int64_t ready_ns = LazyTimer::kNever;  ///< when the devices are spoken to after switching on
  };

  /// Opens the line and follows its state; false when it cannot be taken.
  bool take(Supply& supply, std::int64_t now_ns);
  /// Why the supply was not switched; empty: it is.
  [[nodiscard]] std::string switch_to(Supply& supply, bool on, std::int64_t now_ns);
  void settle(Supply& supply, std::int64_t now_ns);
  void cut(const Supply& supply, std::int64_t now_ns, const std::string& reason) const;
  void ring();
  [[nodiscard]] std::string list() const;

  const Sessions& sessions_;
  PowerOwner& owner_;
  OpenLine open_;
  std::vector<Supply> supplies_;
  LazyTimer timer_;
};

}  // namespace navcal::daemon
