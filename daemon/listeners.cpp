// SPDX-License-Identifier: Apache-2.0
#include "daemon/listeners.h"

#include <fmt/format.h>
#include <sys/socket.h>
#include <sys/stat.h>

#include "base/service_manager.h"
#include "daemon/start_error.h"

namespace navcal::daemon {

namespace asio = boost::asio;
using Unix = asio::local::stream_protocol;
namespace {

constexpr std::uint16_t kGpsdPort = 2947;
constexpr std::size_t kMaxUnixPath = 107;  ///< sun_path less its terminator

/// Sets the process's umask for as long as it lives. Only the I/O thread makes files then.
class Umask {
 public:
  explicit Umask(mode_t mask) : former_(::umask(mask)) {}
  ~Umask() { ::umask(former_); }
  Umask(const Umask&) = delete;
  Umask& operator=(const Umask&) = delete;

 private:
  mode_t former_;
};

std::string taken(const config::StatusSettings& settings) {
  std::string message = fmt::format("port {} at {} is taken", settings.port, settings.address);
  if (settings.port == kGpsdPort) {
    message +=
        ", usually by gpsd's own socket unit: `systemctl disable --now gpsd.socket gpsd.service` frees it, or "
        "choose another with status.port";
  } else {
    message += ", perhaps by another navcald: choose another with status.port";
  }
  return message;
}

/// True when a server answers at the socket.
bool is_alive(const asio::any_io_executor& executor, const std::string& path) {
  Unix::socket socket(executor);
  boost::system::error_code error;
  socket.connect(Unix::endpoint(path), error);
  return !error;
}

}  // namespace

asio::ip::tcp::acceptor listen_status(const asio::any_io_executor& executor,
                                      const config::StatusSettings& settings) {
  boost::system::error_code error;
  const std::string literal = settings.address == "localhost" ? "127.0.0.1" : settings.address;
  const auto address = asio::ip::make_address(literal, error);
  if (error) throw StartError(fmt::format("status.address: \"{}\" is not an IP address", settings.address));
  const asio::ip::tcp::endpoint endpoint(address, settings.port);
  asio::ip::tcp::acceptor acceptor(executor);
  acceptor.open(endpoint.protocol());
  acceptor.set_option(asio::socket_base::reuse_address(true));
  acceptor.bind(endpoint, error);
  if (!error) acceptor.listen(asio::socket_base::max_listen_connections, error);
  if (error == asio::error::address_in_use) throw StartError(taken(settings));
  if (error) {
    throw StartError(
        fmt::format("cannot listen at {} port {}: {}", settings.address, settings.port, error.message()));
  }
  return acceptor;
}

Unix::acceptor listen_control(const asio::any_io_executor& executor, const config::ControlSettings& settings) {
  const std::string path = settings.socket.string();
  const auto failed = [&](const std::string& why) { return StartError("control socket " + path + ": " + why); };
  if (path.size() > kMaxUnixPath) throw failed(fmt::format("longer than {} bytes", kMaxUnixPath));
  std::error_code folder_error;
  std::filesystem::create_directories(settings.socket.parent_path(), folder_error);
  if (folder_error) throw failed("its folder cannot be made: " + folder_error.message());

  const Unix::endpoint endpoint(path);
  Unix::acceptor acceptor(executor);
  acceptor.open(endpoint.protocol());
  boost::system::error_code error;
  const Umask umask(static_cast<mode_t>(~settings.mode & 0777U));
  acceptor.bind(endpoint, error);
  if (error == asio::error::address_in_use) {
    if (!std::filesystem::is_socket(settings.socket)) throw failed("there is a file of this name already");
    if (is_alive(executor, path)) throw failed("another navcald answers there");
    std::filesystem::remove(settings.socket);
    acceptor.bind(endpoint, error);
  }
  if (!error) acceptor.listen(asio::socket_base::max_listen_connections, error);
  if (error) throw failed(error.message());
  return acceptor;
}

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
