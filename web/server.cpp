// SPDX-License-Identifier: Apache-2.0
#include "web/server.h"

#include <algorithm>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/write.hpp>
#include <boost/beast/websocket/rfc6455.hpp>
#include <boost/beast/websocket/stream.hpp>
#include <deque>
#include <string>

#include "ports/no_throw.h"
#include "web/peer.h"

namespace navcal::web {

namespace asio = boost::asio;
namespace websocket = boost::beast::websocket;
using ports::kNoThrow;

/// One WebSocket client: reads its messages, and writes what waits for it, one message after the other.
class WebSocketSession final : public PeerLink, public std::enable_shared_from_this<WebSocketSession> {
 public:
  WebSocketSession(boost::beast::tcp_stream stream, const ServerLimits& limits, ServerCounters& counters,
                   bool is_local)
      : stream_(std::move(stream)), limits_(limits), counters_(counters), is_local_(is_local) {}

  /// Answers the handshake and serves until the connection ends.
  boost::asio::awaitable<void> serve(Request request, const WebSocketEndpoint& endpoint, std::string subprotocol) {
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

  bool send(Payload payload) override {
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
  void close(std::string_view reason) override {
    if (!open_ || !close_reason_.empty()) return;
    // A close frame has room for 123 bytes of reason.
    close_reason_ = reason.empty() ? "closed" : std::string(reason.substr(0, 120));
    if (writing_) return;
    writing_ = true;
    asio::co_spawn(
        stream_.get_executor(), [self = shared_from_this()] { return self->write_queue(); }, asio::detached);
  }
  void show_token() override { has_token_ = true; }
  [[nodiscard]] bool is_from_here() const override { return is_local_; }
  [[nodiscard]] std::size_t queued_bytes() const override { return queued_bytes_; }
  [[nodiscard]] bool has_token() const { return has_token_; }
  /// Closes the connection without a word, which would have to wait for the client.
  void drop() { boost::beast::get_lowest_layer(stream_).close(); }

 private:
  boost::asio::awaitable<void> read_messages() {
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
  boost::asio::awaitable<void> write_queue() {
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

  boost::beast::websocket::stream<boost::beast::tcp_stream> stream_;
  const ServerLimits& limits_;
  ServerCounters& counters_;
  std::unique_ptr<Peer> peer_;
  std::deque<Payload> queue_;
  std::size_t queued_bytes_ = 0;
  bool open_ = false;
  bool writing_ = false;
  bool has_token_ = false;
  bool is_local_;
  std::string close_reason_;
};

namespace beast = boost::beast;
namespace http = beast::http;

namespace {

constexpr auto kAcceptPause = std::chrono::milliseconds(200);

std::string_view text(beast::string_view view) { return {view.data(), view.size()}; }

/// Null when the error is only the end of a connection.
std::optional<Response> answer_to_broken(const boost::system::error_code& error) {
  if (error == http::error::end_of_stream || error == beast::error::timeout) return std::nullopt;
  if (error == http::error::header_limit)
    return refuse(http::status::request_header_fields_too_large, "the request's header is too large");
  if (error == http::error::body_limit) return refuse(http::status::payload_too_large, "the request is too large");
  if (error.category() == make_error_code(http::error::bad_method).category())
    return refuse(http::status::bad_request, "that is no HTTP/1.1: " + error.message());
  return std::nullopt;
}

}  // namespace

Server::Server(asio::ip::tcp::acceptor acceptor, const Site& site, const Access& access, ServerLimits limits)
    : acceptor_(std::move(acceptor)), site_(site), access_(access), limits_(limits) {}

std::uint16_t Server::port() const {
  boost::system::error_code closed;
  return acceptor_.local_endpoint(closed).port();
}

void Server::start() {
  asio::co_spawn(
      acceptor_.get_executor(), [self = shared_from_this()] { return self->accept_clients(); }, asio::detached);
}

void Server::stop() {
  boost::system::error_code ignored;
  acceptor_.close(ignored);
  for (const auto& client : std::list(clients_))
    if (client->session) client->session->close("navcal-web stops");
}

asio::awaitable<void> Server::accept_clients() {
  while (acceptor_.is_open()) {
    auto [error, socket] = co_await acceptor_.async_accept(kNoThrow);
    if (!acceptor_.is_open()) co_return;
    if (error) {
      // Out of descriptors, most likely: others have to go first.
      asio::steady_timer pause(acceptor_.get_executor(), kAcceptPause);
      co_await pause.async_wait(kNoThrow);
      continue;
    }
    if (!make_room()) continue;
    ++counters_.connections;
    boost::system::error_code ignored;
    socket.set_option(asio::ip::tcp::no_delay(true), ignored);
    const auto client = std::make_shared<Client>(Client{beast::tcp_stream(std::move(socket)), nullptr});
    clients_.push_back(client);
    asio::co_spawn(
        acceptor_.get_executor(), [self = shared_from_this(), client] { return self->serve(client); },
        [self = shared_from_this(), client](const std::exception_ptr&) { self->clients_.remove(client); });
  }
}

bool Server::make_room() {
  if (clients_.size() < limits_.connections) return true;
  ++counters_.connections_refused;
  // The oldest, whatever it does: a viewer answers pings for as long as it likes, and a connection that is on its
  // way to show the token is among the newest.
  const auto oldest = std::ranges::find_if(
      clients_, [](const auto& client) { return !client->session || !client->session->has_token(); });
  if (oldest == clients_.end()) return false;
  const auto client = *oldest;
  clients_.erase(oldest);
  if (client->session) {
    client->session->drop();
  } else {
    client->stream.close();
  }
  return true;
}

asio::awaitable<void> Server::serve(std::shared_ptr<Client> client) {
  beast::tcp_stream& stream = client->stream;
  beast::flat_buffer buffer;
  bool keep_alive = true;
  while (keep_alive) {
    http::request_parser<http::string_body> parser;
    parser.header_limit(static_cast<std::uint32_t>(limits_.header_bytes));
    parser.body_limit(limits_.body_bytes);
    stream.expires_after(limits_.request);
    const auto [error, n] = co_await http::async_read(stream, buffer, parser, kNoThrow);
    if (error == http::error::end_of_stream) break;
    Response response;
    if (error) {
      ++counters_.requests_broken;
      auto broken = answer_to_broken(error);
      if (!broken) break;
      response = std::move(*broken);
      keep_alive = false;
    } else {
      ++counters_.requests;
      Request request = parser.release();
      if (beast::websocket::is_upgrade(request)) {
        std::string subprotocol;
        std::optional<Response> refusal;
        const WebSocketEndpoint* endpoint = endpoint_for(request, subprotocol, refusal);
        if (endpoint != nullptr) {
          boost::system::error_code gone;
          const bool is_local = is_from_here(stream.socket().remote_endpoint(gone).address().to_string(),
                                             text(request[http::field::host]), text(request[http::field::origin]));
          client->session = std::make_shared<WebSocketSession>(std::move(stream), limits_, counters_, is_local);
          auto work = client->session->serve(std::move(request), *endpoint, std::move(subprotocol));
          co_await std::move(work);
          co_return;
        }
        response = std::move(*refusal);
        keep_alive = false;
      } else {
        keep_alive = request.keep_alive();
        response = co_await answer(request);
      }
      if (response.result_int() >= 400) ++counters_.requests_refused;
      if (request.method() == http::verb::head) response.body().clear();
    }
    response.keep_alive(keep_alive);
    stream.expires_after(limits_.request);
    const auto [write_error, written] = co_await http::async_write(stream, response, kNoThrow);
    if (write_error) break;
  }
  boost::system::error_code ignored;
  stream.socket().shutdown(asio::ip::tcp::socket::shutdown_send, ignored);
}

asio::awaitable<Response> Server::answer(const Request& request) {
  if (!access_.knows_host(text(request[http::field::host])))
    co_return refuse(http::status::misdirected_request,
                     "this server is not known by that name; --host-name adds one");
  bool path_exists = false;
  const std::string_view path = path_of(text(request.target()));
  const Handler* handler = site_.handler(text(request.method_string()), path, path_exists);
  if (handler == nullptr && path_exists)
    co_return refuse(http::status::method_not_allowed, "not with this method");
  if (handler == nullptr) co_return refuse(http::status::not_found, "there is no " + std::string(path));
  // Named, because g++ 12 destroys temporaries of an awaited expression twice.
  asio::awaitable<Response> work = (*handler)(request);
  Response response = co_await std::move(work);
  co_return response;
}

const WebSocketEndpoint* Server::endpoint_for(const Request& request, std::string& subprotocol,
                                              std::optional<Response>& refusal) const {
  const std::string_view host = text(request[http::field::host]);
  if (!access_.knows_host(host)) {
    refusal =
        refuse(http::status::misdirected_request, "this server is not known by that name; --host-name adds one");
    return nullptr;
  }
  const WebSocketEndpoint* endpoint = site_.endpoint(
      path_of(text(request.target())), text(request[http::field::sec_websocket_protocol]), subprotocol);
  if (endpoint == nullptr) {
    refusal = refuse(http::status::not_found, "no WebSocket is served there with these subprotocols");
    return nullptr;
  }
  const std::string_view origin = text(request[http::field::origin]);
  if (!access_.knows_origin(origin, host) &&
      std::ranges::find(endpoint->origins, origin) == endpoint->origins.end()) {
    refusal =
        refuse(http::status::forbidden, "a page of another site may not connect here; --allow-origin adds one");
    return nullptr;
  }
  return endpoint;
}

}  // namespace navcal::web
