// SPDX-License-Identifier: Apache-2.0
#include "web/web_socket_session.h"

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>

#include "ports/no_throw.h"

namespace navcal::web {
namespace asio = boost::asio;
namespace websocket = boost::beast::websocket;
using ports::kNoThrow;

WebSocketSession::WebSocketSession(boost::beast::tcp_stream stream, const ServerLimits& limits,
                                   ServerCounters& counters)
    : stream_(std::move(stream)), limits_(limits), counters_(counters) {}

asio::awaitable<void> WebSocketSession::serve(Request request, const WebSocketEndpoint& endpoint,
                                              std::string subprotocol) {
  // From here on the WebSocket's own limits of time hold.
  stream_.next_layer().expires_never();
  websocket::stream_base::timeout timeout{limits_.request, limits_.silence, true};
  stream_.set_option(timeout);
  stream_.set_option(websocket::stream_base::decorator([&subprotocol](websocket::response_type& response) {
    response.set(boost::beast::http::field::server, "navcal");
    if (!subprotocol.empty()) response.set(boost::beast::http::field::sec_websocket_protocol, subprotocol);
  }));
  stream_.read_message_max(limits_.message_bytes);
  const std::string target(request.target());
  const auto [error] = co_await stream_.async_accept(request, kNoThrow);
  if (error) co_return;
  open_ = true;
  ++counters_.web_sockets;
  ++counters_.web_sockets_open;
  peer_ = endpoint.make_peer(*this, target);
  peer_->on_open();
  co_await read_messages();
  open_ = false;
  --counters_.web_sockets_open;
  peer_.reset();
  drop();
}

asio::awaitable<void> WebSocketSession::read_messages() {
  boost::beast::flat_buffer buffer;
  for (;;) {
    const auto [error, n] = co_await stream_.async_read(buffer, kNoThrow);
    if (error) co_return;
    const std::string_view message(static_cast<const char*>(buffer.data().data()), buffer.size());
    if (stream_.got_text()) {
      peer_->on_text(message);
    } else {
      peer_->on_binary(message);
    }
    buffer.consume(buffer.size());
  }
}

bool WebSocketSession::send(Payload payload) {
  if (!open_) return false;
  if (queued_bytes_ > 0 && queued_bytes_ + payload.bytes->size() > limits_.queue_bytes) {
    ++counters_.messages_dropped;
    return false;
  }
  queued_bytes_ += payload.bytes->size();
  queue_.push_back(std::move(payload));
  if (!writing_) {
    writing_ = true;
    asio::co_spawn(
        stream_.get_executor(), [self = shared_from_this()] { return self->write_queue(); }, asio::detached);
  }
  return true;
}

asio::awaitable<void> WebSocketSession::write_queue() {
  while (open_ && !queue_.empty()) {
    const Payload payload = queue_.front();
    stream_.binary(payload.binary);
    const auto [error, n] = co_await stream_.async_write(asio::buffer(*payload.bytes), kNoThrow);
    if (error) {
      // The reader learns of the end by itself: the connection is closed under it.
      drop();
      break;
    }
    ++counters_.messages_sent;
    counters_.bytes_sent += payload.bytes->size();
    queued_bytes_ -= payload.bytes->size();
    queue_.pop_front();
    if (queue_.empty() && open_ && peer_) peer_->on_drained();
  }
  writing_ = false;
  if (!open_ || close_reason_.empty()) co_return;
  const websocket::close_reason reason(websocket::close_code::going_away, close_reason_);
  co_await stream_.async_close(reason, kNoThrow);
}

void WebSocketSession::close(std::string_view reason) {
  if (!open_ || !close_reason_.empty()) return;
  // A close frame has room for 123 bytes of reason.
  close_reason_ = reason.empty() ? "closed" : std::string(reason.substr(0, 120));
  if (writing_) return;
  writing_ = true;
  asio::co_spawn(
      stream_.get_executor(), [self = shared_from_this()] { return self->write_queue(); }, asio::detached);
}

}  // namespace navcal::web
