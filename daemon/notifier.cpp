#include "daemon/notifier.h"

#include "daemon/service_manager.h"

namespace navcal::daemon {

Notifier::Notifier(boost::asio::any_io_executor executor) : timer_(std::move(executor)) {
  // A third of what systemd allows: one late feeding is not yet a death sentence.
  interval_ = watchdog_limit() / 3;
}

void Notifier::ready() {
  notify_manager("READY=1", IfBusy::wait);
  if (interval_.count() > 0) feed_watchdog();
}

void Notifier::feed_watchdog() {
  notify_manager("WATCHDOG=1");
  timer_.expires_after(interval_);
  timer_.async_wait([this](boost::system::error_code error) {
    if (!error) feed_watchdog();
  });
}

void Notifier::status(std::string_view text) {
  if (text == last_status_) return;
  last_status_ = text;
  notify_manager("STATUS=" + last_status_);
}

void Notifier::stopping() {
  timer_.cancel();
  notify_manager("STOPPING=1", IfBusy::wait);
}

}  // namespace navcal::daemon
