#include "daemon/notifier.h"

#include <systemd/sd-daemon.h>

namespace navcal::daemon {

Notifier::Notifier(boost::asio::any_io_executor executor) : timer_(std::move(executor)) {
  std::uint64_t limit_us = 0;
  // A third of what systemd allows: one late feeding is not yet a death sentence.
  if (sd_watchdog_enabled(0, &limit_us) > 0) interval_ = std::chrono::microseconds(limit_us / 3);
}

void Notifier::ready() {
  sd_notify(0, "READY=1");
  if (interval_.count() > 0) feed_watchdog();
}

void Notifier::feed_watchdog() {
  sd_notify(0, "WATCHDOG=1");
  timer_.expires_after(interval_);
  timer_.async_wait([this](boost::system::error_code error) {
    if (!error) feed_watchdog();
  });
}

void Notifier::status(std::string_view text) {
  if (text == last_status_) return;
  last_status_ = text;
  sd_notifyf(0, "STATUS=%s", last_status_.c_str());
}

void Notifier::stopping() {
  timer_.cancel();
  sd_notify(0, "STOPPING=1");
}

}  // namespace navcal::daemon
