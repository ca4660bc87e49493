// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/asio/awaitable.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/websocket/stream.hpp>
#include <deque>
#include <memory>
#include <string>

#include "web/peer.h"
#include "web/server.h"

namespace navcal::web {

/// One WebSocket client: reads its messages, and writes what waits for it, one message after the other.
class WebSocketSession final : public PeerLink, public std::enable_shared_from_this<WebSocketSession> {
 public:
  WebSocketSession(boost::beast::tcp_stream stream, const ServerLimits& limits, ServerCounters& counters);

  /// Answers the handshake and serves until the connection ends.
  boost::asio::awaitable<void> serve(Request request, const WebSocketEndpoint& endpoint, std::string subprotocol);

  bool send(Payload payload) override;
  void close(std::string_view reason) override;
  void show_token() override { has_token_ = true; }
  [[nodiscard]] std::size_t queued_bytes() const override { return queued_bytes_; }
  [[nodiscard]] bool has_token() const { return has_token_; }
  /// Closes the connection without a word, which would have to wait for the client.
  void drop() { boost::beast::get_lowest_layer(stream_).close(); }

 private:
  boost::asio::awaitable<void> read_messages();
  boost::asio::awaitable<void> write_queue();

  boost::beast::websocket::stream<boost::beast::tcp_stream> stream_;
  const ServerLimits& limits_;
  ServerCounters& counters_;
  std::unique_ptr<Peer> peer_;
  std::deque<Payload> queue_;
  std::size_t queued_bytes_ = 0;
  bool open_ = false;
  bool writing_ = false;
  bool has_token_ = false;
  std::string close_reason_;
};

}  // namespace navcal::web
