// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace navcal::web {

/// One WebSocket message. Many peers may share one text, which is then kept once.
struct Payload {
  std::shared_ptr<const std::string> bytes;
  bool binary = false;
};

/// The way to one WebSocket client.
class PeerLink {
 public:
  virtual ~PeerLink() = default;
  /// Never waits. False when the client is too slow and its queue is full: the message is then dropped whole.
  virtual bool send(Payload payload) = 0;
  virtual void close(std::string_view reason) = 0;
  /// The client has shown the token: it keeps its place, however many others come.
  virtual void show_token() {}
  /// The client runs on this computer (web/access.h).
  [[nodiscard]] virtual bool is_from_here() const { return false; }
  /// Bytes that wait for the client.
  [[nodiscard]] virtual std::size_t queued_bytes() const = 0;

  bool send_text(std::string text) { return send({std::make_shared<const std::string>(std::move(text)), false}); }
};

/// What this program says to one WebSocket client. It is made when the client has connected, and destroyed after
/// the connection has ended.
class Peer {
 public:
  virtual ~Peer() = default;
  virtual void on_open() = 0;
  /// A text message, valid UTF-8, of limited size.
  virtual void on_text(std::string_view text) = 0;
  virtual void on_binary(std::string_view /*bytes*/) {}
  /// Everything that waited for the client has been written.
  virtual void on_drained() {}
};

/// A kind of WebSocket client. The first whose path is that of the request, and of whose subprotocols the client
/// offers one, serves it; an endpoint without subprotocols serves clients that offer none.
struct WebSocketEndpoint {
  std::string path;
  std::vector<std::string> subprotocols{};
  /// Sites whose pages may connect, besides those that Access knows.
  std::vector<std::string> origins{};
  std::function<std::unique_ptr<Peer>(PeerLink&, std::string_view target)> make_peer{};
};

}  // namespace navcal::web
