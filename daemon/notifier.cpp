// SPDX-License-Identifier: Apache-2.0
#include "daemon/notifier.h"

#include "base/service_manager.h"
#include "ports/port.h"

namespace navcal::daemon {

Notifier::Notifier(const boost::asio::any_io_executor& executor) : timer_(executor, [this] { feed_watchdog(); }) {
  // A third of what systemd allows: one late feeding is not yet a death sentence.
  interval_ = base::watchdog_limit() / 3;
}

void Notifier::ready() {
  base::notify_manager("READY=1", base::IfBusy::wait);
  if (interval_.count() > 0) feed_watchdog();
}

void Notifier::feed_watchdog() {
  base::notify_manager("WATCHDOG=1");
  timer_.arm(ports::monotonic_ns() + std::chrono::nanoseconds(interval_).count());
}

void Notifier::status(std::string_view text) {
  if (text == last_status_) return;
  last_status_ = text;
  base::notify_manager("STATUS=" + last_status_);
}

void Notifier::stopping() {
  timer_.stop();
  base::notify_manager("STOPPING=1", base::IfBusy::wait);
}

}  // namespace navcal::daemon
