// SPDX-License-Identifier: Apache-2.0
#include "web/control_peer.h"

#include <array>
#include <boost/asio/awaitable.hpp>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/local/stream_protocol.hpp>
#include <boost/asio/write.hpp>
#include <nlohmann/json.hpp>

#include "base/line_reader.h"
#include "ports/no_throw.h"
#include "web/http.h"

namespace navcal::web {
namespace asio = boost::asio;
using ports::kNoThrow;
namespace {

/// As long a line as navcald takes.
constexpr std::size_t kMaxControlRequest = 4096;
/// An answer with a piece of a log has 64 KiB, in base64.
constexpr std::size_t kMaxControlAnswer = 128 << 10;
/// Requests that may wait for navcald, which answers one after the other.
constexpr std::size_t kMaxWaiting_bytes = 64 << 10;

/// The connection to navcald, which outlives the WebSocket client by the time that its last operations need.
class ControlConnection : public std::enable_shared_from_this<ControlConnection> {
 public:
  ControlConnection(const asio::any_io_executor& executor, PeerLink& link) : socket_(executor), link_(&link) {}

  void start(const std::filesystem::path& path) {
    boost::system::error_code error;
    socket_.connect(asio::local::stream_protocol::endpoint(path.string()), error);
    if (error) {
      end("navcald's control socket " + path.string() + ": " + error.message());
      return;
    }
    asio::co_spawn(
        socket_.get_executor(), [self = shared_from_this()] { return self->read_answers(); }, asio::detached);
  }

  /// False when too much is waiting.
  bool send(std::string_view request) {
    if (waiting_.size() + request.size() > kMaxWaiting_bytes) return false;
    waiting_.append(request).append("\n");
    if (!writing_) {
      writing_ = true;
      asio::co_spawn(
          socket_.get_executor(), [self = shared_from_this()] { return self->write_requests(); }, asio::detached);
    }
    return true;
  }

  void forget_client() {
    link_ = nullptr;
    boost::system::error_code ignored;
    socket_.close(ignored);
  }

 private:
  asio::awaitable<void> read_answers() {
    std::array<char, 4096> chunk{};
    base::LineReader lines(kMaxControlAnswer);
    for (;;) {
      const auto [error, n] = co_await socket_.async_read_some(asio::buffer(chunk), kNoThrow);
      if (error || link_ == nullptr) break;
      const bool accepted = lines.feed({chunk.data(), n}, [this](std::string_view line) {
        if (link_ != nullptr) link_->send_text(std::string(line));
      });
      if (!accepted) break;
    }
    end("navcald closed the control connection");
  }
  asio::awaitable<void> write_requests() {
    while (!waiting_.empty()) {
      const std::string writing = std::exchange(waiting_, {});
      const auto [error, n] = co_await asio::async_write(socket_, asio::buffer(writing), kNoThrow);
      if (error) break;
    }
    writing_ = false;
  }
  void end(const std::string& why) {
    if (link_ == nullptr) return;
    link_->send_text(refusal(why));
    link_->close(why);
    forget_client();
  }

  asio::local::stream_protocol::socket socket_;
  PeerLink* link_;  ///< null once the client has gone
  std::string waiting_;
  bool writing_ = false;
};

class ControlPeer final : public Peer {
 public:
  ControlPeer(const asio::any_io_executor& executor, PeerLink& link, std::filesystem::path path,
              const Access& access)
      : link_(link), path_(std::move(path)), access_(access),
        connection_(std::make_shared<ControlConnection>(executor, link)) {}
  ~ControlPeer() override { connection_->forget_client(); }
  ControlPeer(const ControlPeer&) = delete;
  ControlPeer& operator=(const ControlPeer&) = delete;

  void on_open() override {}
  void on_text(std::string_view text) override {
    if (!admitted_) {
      admit(text);
    } else if (text.size() > kMaxControlRequest || text.find_first_of("\r\n") != std::string_view::npos) {
      link_.send_text(refusal("a request is one line of at most 4096 bytes"));
    } else if (!connection_->send(text)) {
      link_.send_text(refusal("navcald does not answer; too many requests wait"));
    }
  }

 private:
  void admit(std::string_view text) {
    const auto request = nlohmann::json::parse(text, nullptr, false);
    std::string token;
    if (request.is_object() && request.contains("token") && request["token"].is_string())
      token = request["token"].get<std::string>();
    if (const auto why = access_.refusal("Bearer " + token)) {
      link_.send_text(refusal(*why));
      link_.close(*why);
      return;
    }
    admitted_ = true;
    link_.show_token();
    link_.send_text(R"({"ok":true})");
    connection_->start(path_);
  }

  PeerLink& link_;
  std::filesystem::path path_;
  const Access& access_;
  std::shared_ptr<ControlConnection> connection_;
  bool admitted_ = false;
};

}  // namespace

WebSocketEndpoint control_endpoint(const asio::any_io_executor& executor, std::string path,
                                   std::filesystem::path control_socket, const Access& access) {
  return {.path = std::move(path),
          .make_peer = [executor, control_socket = std::move(control_socket), &access](
                           PeerLink& link, std::string_view) -> std::unique_ptr<Peer> {
            return std::make_unique<ControlPeer>(executor, link, control_socket, access);
          }};
}

}  // namespace navcal::web
