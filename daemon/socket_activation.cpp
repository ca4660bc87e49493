// SPDX-License-Identifier: Apache-2.0
#include "daemon/socket_activation.h"

#include <fmt/format.h>
#include <sys/socket.h>

#include "base/service_manager.h"
#include "daemon/start_error.h"

namespace navcal::daemon {
namespace asio = boost::asio;

ActivatedSockets take_activated_sockets(const asio::any_io_executor& executor) {
  ActivatedSockets sockets;
  const int count = base::take_handed_over();
  for (int fd = base::kFirstHandedOver; fd < base::kFirstHandedOver + count; ++fd) {
    const bool v4 = base::is_listening(fd, AF_INET);
    if ((v4 || base::is_listening(fd, AF_INET6)) && !sockets.status) {
      sockets.status.emplace(executor, v4 ? asio::ip::tcp::v4() : asio::ip::tcp::v6(), fd);
    } else if (base::is_listening(fd, AF_UNIX) && !sockets.control) {
      sockets.control.emplace(executor, asio::local::stream_protocol(), fd);
    } else {
      throw StartError(fmt::format(
          "socket activation: descriptor {} is neither the status (TCP) nor the control (Unix) socket", fd));
    }
  }
  return sockets;
}

}  // namespace navcal::daemon
