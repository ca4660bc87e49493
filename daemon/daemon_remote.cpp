// SPDX-License-Identifier: Apache-2.0
// The remote link and the vehicle.
#include <boost/asio/post.hpp>

#include "daemon/daemon.h"

namespace navcal::daemon {

link::Report Daemon::remote_report(std::int64_t now_ns) {
  return remote_report_.of(vehicle_state(now_ns), pipeline_, now_ns);
}

void Daemon::remote_answer(const ControlRequest& request, const ControlOrigin& origin, Reply reply) {
  ControlAnswer made = answer(request, origin);
  if (!made.work) return reply(made.text);
  // The disk may be slow, and the I/O thread waits for nothing.
  if (!remote_reader_) remote_reader_.emplace(2);
  boost::asio::post(*remote_reader_, [io = executor_, work = std::move(made.work), then = std::move(made.then),
                                      reply = std::move(reply)] {
    std::string line;
    try {
      line = work();
    } catch (const std::exception& error) {
      line = control_error(error.what());
    }
    boost::asio::post(io, [line = std::move(line), then, reply] { reply(then ? then(line) : line); });
  });
}

void Daemon::end_every_lease() {
  if (!motor_) return;
  if (const auto& holder = motor_->command().holder())
    motor_->client_gone(holder->client, "the remote link is dead");
}

void Daemon::on_remote_dead(std::int64_t now_ns, bool is_dead) {
  set_alarm(kRemotePort, Alarm::link_dead, is_dead, now_ns);
}

}  // namespace navcal::daemon
