#include "daemon/socket_activation.h"

#include <fmt/format.h>
#include <sys/socket.h>
#include <systemd/sd-daemon.h>

#include "daemon/start_error.h"

namespace navcal::daemon {
namespace asio = boost::asio;
namespace {

bool listens(int descriptor, int family) { return sd_is_socket(descriptor, family, SOCK_STREAM, 1) > 0; }

}  // namespace

ActivatedSockets take_activated_sockets(const asio::any_io_executor& executor) {
  ActivatedSockets sockets;
  const int count = sd_listen_fds(1);
  for (int fd = SD_LISTEN_FDS_START; fd < SD_LISTEN_FDS_START + count; ++fd) {
    const bool v4 = listens(fd, AF_INET);
    if ((v4 || listens(fd, AF_INET6)) && !sockets.status) {
      sockets.status.emplace(executor, v4 ? asio::ip::tcp::v4() : asio::ip::tcp::v6(), fd);
    } else if (listens(fd, AF_UNIX) && !sockets.control) {
      sockets.control.emplace(executor, asio::local::stream_protocol(), fd);
    } else {
      throw StartError(fmt::format(
          "socket activation: descriptor {} is neither the status (TCP) nor the control (Unix) socket", fd));
    }
  }
  return sockets;
}

}  // namespace navcal::daemon
