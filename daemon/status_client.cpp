// SPDX-License-Identifier: Apache-2.0
#include "daemon/status_client.h"

#include <spdlog/spdlog.h>
#include <sys/socket.h>

#include <array>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <cerrno>
#include <exception>

#include "base/line_reader.h"
#include "daemon/gpsd_replies.h"
#include "ports/no_throw.h"
#include "ports/port.h"

namespace navcal::daemon {
namespace asio = boost::asio;
namespace {

/// Together with the queue this bounds what one client may hold; the kernel books twice what is asked for.
constexpr int kSendBuffer_bytes = 32 << 10;
constexpr auto kFarewell = std::chrono::seconds(2);
constexpr auto kSlowDown = std::chrono::milliseconds(50);
constexpr auto kUnread = std::chrono::milliseconds(200);

}  // namespace

StatusClient::StatusClient(asio::ip::tcp::socket socket, std::size_t queue_bytes, ClientOwner& owner)
    : socket_(std::move(socket)), pause_(socket_.get_executor()), requests_(kMaxRequests_Hz), queue_(queue_bytes),
      owner_(owner), used_ns_(ports::monotonic_ns()) {
  // A client that is gone already fails these; reading will tell.
  boost::system::error_code ignored;
  socket_.set_option(asio::ip::tcp::no_delay(true), ignored);
  socket_.set_option(asio::socket_base::send_buffer_size(kSendBuffer_bytes), ignored);
  socket_.set_option(asio::socket_base::keep_alive(true), ignored);
}

void StatusClient::start() {
  asio::co_spawn(socket_.get_executor(), session(), [self = shared_from_this()](const std::exception_ptr& error) {
    try {
      if (error) std::rethrow_exception(error);
    } catch (const std::exception& e) {
      spdlog::warn("status client dropped: {}", e.what());
    }
    self->close();
    self->owner_.on_gone(*self);
  });
}

asio::awaitable<void> StatusClient::session() {
  std::string greeting;
  append_version(greeting);
  send(greeting);
  co_await read_requests();
}

asio::awaitable<void> StatusClient::read_requests() {
  std::array<char, 1024> chunk{};
  base::LineReader lines(kMaxRequestLength);
  for (;;) {
    const auto [error, n] = co_await socket_.async_read_some(asio::buffer(chunk), ports::kNoThrow);
    if (error) co_return;
    used_ns_ = ports::monotonic_ns();
    std::vector<Request> requests;
    const auto take = [&requests](std::string_view line) {
      for (Request& request : parse_requests(line)) requests.push_back(std::move(request));
    };
    const bool accepted = lines.feed({chunk.data(), n}, take);
    if (const std::size_t complete = complete_length(lines.held())) {
      take(lines.held().substr(0, complete));
      lines.forget(complete);
    }
    // Named, because g++ 12 destroys temporaries of an awaited expression twice.
    asio::awaitable<void> answering = answer(std::move(requests));
    co_await std::move(answering);
    if (accepted) continue;
    co_await refuse("Request line too long");
    co_return;
  }
}

asio::awaitable<void> StatusClient::answer(std::vector<Request> requests) {
  for (const Request& request : requests) {
    while (socket_.is_open() && (!queue_.empty() || !requests_.take(ports::monotonic_ns()))) {
      pause_.expires_after(queue_.empty() ? kSlowDown : kUnread);
      co_await pause_.async_wait(ports::kNoThrow);
    }
    if (!socket_.is_open()) co_return;
    owner_.on_request(*this, request);
  }
}

/// Says why, then reads on for a moment: closing with bytes unread would take the message from the client again.
asio::awaitable<void> StatusClient::refuse(std::string_view reason) {
  policy_ = {};
  std::string message;
  append_error(message, reason);
  send(message);
  boost::system::error_code ignored;
  socket_.shutdown(asio::socket_base::shutdown_send, ignored);
  pause_.expires_after(kFarewell);
  pause_.async_wait([self = shared_from_this()](boost::system::error_code error) {
    if (!error) self->close();
  });
  std::array<char, 4096> discarded{};
  for (;;) {
    const auto [error, n] = co_await socket_.async_read_some(asio::buffer(discarded), ports::kNoThrow);
    if (error) break;
  }
  pause_.cancel();
}

bool StatusClient::is_due(ReportClass report, std::uint16_t slot) const {
  const std::int64_t interval = interval_ns(report);
  return interval == 0 || pacer_.is_due(report, slot, interval, ports::monotonic_ns());
}

bool StatusClient::take_turn(ReportClass report, std::uint16_t slot) {
  const std::int64_t interval = interval_ns(report);
  return interval == 0 || pacer_.take(report, slot, interval, ports::monotonic_ns());
}

std::int64_t StatusClient::interval_ns(const RecordKey& key) const {
  return key.at_a_rate ? policy_.topic_intervals_ns.of(key.topic).value_or(interval_ns(ReportClass::record)) : 0;
}

bool StatusClient::is_due(const RecordKey& key) const {
  const std::int64_t interval = interval_ns(key);
  return interval == 0 || pacer_.is_due(ReportClass::record, key.slot(), interval, ports::monotonic_ns());
}

bool StatusClient::take_turn(const RecordKey& key) {
  const std::int64_t interval = interval_ns(key);
  return interval == 0 || pacer_.take(ReportClass::record, key.slot(), interval, ports::monotonic_ns());
}

bool StatusClient::is_due(const NmeaKey& key) const {
  return nmea_pacer_.is_due(key.like, key.port, policy_.nmea_interval_ns, ports::monotonic_ns());
}

bool StatusClient::take_turn(const NmeaKey& key) {
  return nmea_pacer_.take(key.like, key.port, policy_.nmea_interval_ns, ports::monotonic_ns());
}

void StatusClient::send(std::string_view report) {
  if (!socket_.is_open()) return;
  if (!queue_.empty()) {
    queue_.push(report);
    return;
  }
  const ssize_t sent = ::send(socket_.native_handle(), report.data(), report.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
  if (sent == static_cast<ssize_t>(report.size())) return;
  if (sent < 0 && errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR) {
    close();
    return;
  }
  if (sent > 0) {
    queue_.push_rest(report.substr(static_cast<std::size_t>(sent)));
  } else {
    queue_.push(report);
  }
  wait_until_writable();
}

void StatusClient::wait_until_writable() {
  if (waiting_ || queue_.empty()) return;
  waiting_ = true;
  socket_.async_wait(asio::socket_base::wait_write, [self = shared_from_this()](boost::system::error_code error) {
    self->waiting_ = false;
    if (!error) self->flush();
  });
}

void StatusClient::flush() {
  while (!queue_.empty()) {
    const std::string_view next = queue_.front();
    const ssize_t sent = ::send(socket_.native_handle(), next.data(), next.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
    if (sent < 0) {
      if (errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR) {
        close();
        return;
      }
      wait_until_writable();
      return;
    }
    queue_.pop(static_cast<std::size_t>(sent));
  }
  if (queue_.dropped() != told_dropped_) {
    told_dropped_ = queue_.dropped();
    owner_.on_caught_up(*this);
  }
}

void StatusClient::close() {
  boost::system::error_code ignored;
  pause_.cancel();
  socket_.close(ignored);
}

}  // namespace navcal::daemon
