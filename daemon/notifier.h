// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/asio/any_io_executor.hpp>
#include <chrono>
#include <string>
#include <string_view>

#include "daemon/lazy_timer.h"

namespace navcal::daemon {

/// Tells systemd how the service is (sd_notify(3)); without systemd it does nothing. The watchdog is fed from the
/// I/O loop itself, so it starves when the loop hangs.
class Notifier {
 public:
  explicit Notifier(const boost::asio::any_io_executor& executor);

  void ready();
  /// One line for `systemctl status`; sent when it changed.
  void status(std::string_view text);
  void stopping();

 private:
  void feed_watchdog();

  LazyTimer timer_;
  std::chrono::microseconds interval_{0};
  std::string last_status_;
};

}  // namespace navcal::daemon
