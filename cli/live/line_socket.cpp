// SPDX-License-Identifier: Apache-2.0
#include "cli/live/line_socket.h"

#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "base/failure.h"
#include "base/interruptible.h"

namespace navcal::cli {
namespace {

/// Upper limit of a line; no program that uses these protocols sends a longer one.
constexpr std::size_t kLongestSocketLine = 1 << 20;

[[noreturn]] void refuse_connection(const std::string& address, std::string_view problem) {
  throw std::runtime_error((address.empty() ? "" : address + ": ") + std::string(problem));
}

/// A disk that has to be woken takes some seconds.
constexpr std::chrono::seconds kControlAnswerLimit{30};

[[noreturn]] void fail_control(const std::string& why) { throw base::Failure(base::Exit::failed, why); }

}  // namespace

int milliseconds_until(LineSocket::Clock::time_point until) {
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(until - LineSocket::Clock::now());
  return static_cast<int>(std::max<std::int64_t>(0, left.count()));
}

std::string connect_at_once(int socket, const addrinfo& address) {
  return ::connect(socket, address.ai_addr, address.ai_addrlen) == 0 ? "" : std::strerror(errno);
}

base::Descriptor connect_tcp(const std::string& host, const std::string& port, const ConnectSocket& connect,
                             int socket_flags) {
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  if (const int error = ::getaddrinfo(host.c_str(), port.c_str(), &hints, &found); error != 0)
    throw std::runtime_error(::gai_strerror(error));
  std::string problem = "no address";
  base::Descriptor connected;
  for (const addrinfo* one = found; one != nullptr && connected.get() < 0; one = one->ai_next) {
    base::Descriptor candidate(::socket(one->ai_family, SOCK_STREAM | SOCK_CLOEXEC | socket_flags, 0));
    problem = candidate.get() < 0 ? std::strerror(errno) : connect(candidate.get(), *one);
    if (problem.empty()) connected = std::move(candidate);
  }
  ::freeaddrinfo(found);
  if (connected.get() < 0) throw std::runtime_error(problem);
  return connected;
}

LineSocket LineSocket::tcp(const std::string& host, const std::string& port) {
  const std::string address = host + ":" + port;
  try {
    return LineSocket(connect_tcp(host, port), address);
  } catch (const std::runtime_error& error) {
    refuse_connection(address, error.what());
  }
}

LineSocket LineSocket::unix_domain(const std::filesystem::path& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path.native().size() >= sizeof address.sun_path) refuse_connection(path.native(), "the name is too long");
  std::ranges::copy(path.native(), address.sun_path);
  base::Descriptor descriptor(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
  if (descriptor.get() < 0 ||
      ::connect(descriptor.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    refuse_connection(path.native(), std::strerror(errno));
  }
  return LineSocket(std::move(descriptor), path.native());
}

void LineSocket::fail(std::string_view problem) const { refuse_connection(address_, problem); }

void LineSocket::send(std::string_view text) {
  while (!text.empty()) {
    const ssize_t sent = ::send(descriptor_.get(), text.data(), text.size(), MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent < 0) fail(std::strerror(errno));
    text.remove_prefix(static_cast<std::size_t>(sent));
  }
}

std::optional<std::string> LineSocket::next(Clock::time_point until) {
  for (;;) {
    if (const auto end = bytes_.find('\n'); end != std::string::npos) {
      std::string line = bytes_.substr(0, end);
      bytes_.erase(0, end + 1);
      return line;
    }
    pollfd readable{descriptor_.get(), POLLIN, 0};
    if (::poll(&readable, 1, milliseconds_until(until)) <= 0) return std::nullopt;
    std::array<char, 16384> chunk{};
    const ssize_t taken = ::recv(descriptor_.get(), chunk.data(), chunk.size(), 0);
    if (taken < 0 && errno == EINTR) return std::nullopt;
    if (taken < 0) fail(std::strerror(errno));
    if (taken == 0) fail("navcald closed the connection");
    bytes_.append(chunk.data(), static_cast<std::size_t>(taken));
    if (bytes_.size() > kLongestSocketLine) fail("that is no navcald: it sends no lines");
  }
}

nlohmann::json ControlLink::ask(const nlohmann::json& request) {
  socket_.send(request.dump() + "\n");
  const auto until = LineSocket::Clock::now() + kControlAnswerLimit;
  const auto line = socket_.next(until);
  if (!line) fail_control(base::Interruptible::interrupted() ? "interrupted" : "navcald does not answer");
  return granted_answer(*line);
}

nlohmann::json granted_answer(const std::string& line) {
  auto answer = nlohmann::json::parse(line, nullptr, false);
  if (!answer.is_object()) fail_control("that is no navcald: its answer is no JSON object");
  if (answer.value("ok", false)) return answer;
  fail_control("navcald: " + answer.value("error", std::string("refused")));
}

}  // namespace navcal::cli
