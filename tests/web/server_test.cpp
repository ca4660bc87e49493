// SPDX-License-Identifier: Apache-2.0
// The server as hostile and as slow clients see it, over real sockets.
#include "web/server.h"

#include <gtest/gtest.h>

#include <set>
#include <vector>

#include "tests/support/process.h"
#include "tests/web/web_server.h"

namespace navcal::web {
namespace {

using test::RawClient;
using test::WebServer;
using test::WebSocketClient;

boost::asio::awaitable<Response> say_hello(const Request& request) {
  co_return respond(boost::beast::http::status::ok, "text/plain", "hello " + std::string(request.body()));
}

/// Answers each message with the same text, and counts what it was told.
class Echo final : public Peer {
 public:
  Echo(PeerLink& link, std::set<PeerLink*>& links) : link_(link), links_(links) { links_.insert(&link_); }
  ~Echo() override { links_.erase(&link_); }
  Echo(const Echo&) = delete;
  Echo& operator=(const Echo&) = delete;
  void on_open() override { link_.send_text("welcome"); }
  void on_text(std::string_view text) override { link_.send_text(std::string(text)); }

 private:
  PeerLink& link_;
  std::set<PeerLink*>& links_;
};

class ServerTest : public testing::Test {
 protected:
  void start(ServerLimits limits = {}) {
    server_ = std::make_unique<WebServer>(limits);
    server_->site.add("GET", "/hello", say_hello);
    server_->site.add("POST", "/hello", say_hello);
    WebSocketEndpoint echo;
    echo.path = "/echo";
    echo.make_peer = [this](PeerLink& link, std::string_view) { return std::make_unique<Echo>(link, links_); };
    server_->site.add(echo);
    echo.path = "/open";
    echo.subprotocols = {"a.v1", "b.v1"};
    echo.origins = {"https://app.example"};
    server_->site.add(echo);
    server_->start();
  }
  [[nodiscard]] std::uint16_t port() const { return server_->port(); }

  std::set<PeerLink*> links_;
  std::unique_ptr<WebServer> server_;
};

bool has(const std::string& text, std::string_view part) { return text.find(part) != std::string::npos; }

TEST_F(ServerTest, RequestsOnOneConnectionAreAnsweredInOrder) {
  start();
  RawClient client(port());
  client.send(
      "GET /hello HTTP/1.1\r\nHost: localhost\r\n\r\nPOST /hello HTTP/1.1\r\nHost: localhost\r\nContent-Length: "
      "3\r\n\r\nyouHEAD /hello HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n");
  const std::string all = client.read_to_end();
  const auto first = all.find("\r\n\r\nhello HTTP/1.1 200"), second = all.find("\r\n\r\nhello youHTTP/1.1 200");
  EXPECT_NE(first, std::string::npos) << all;
  EXPECT_LT(first, second) << all;
  EXPECT_TRUE(all.ends_with("\r\n\r\n")) << "HEAD has no body: " << all;
  EXPECT_TRUE(has(all, "nosniff"));
}

TEST_F(ServerTest, WhatIsNotServedHasAReason) {
  start();
  EXPECT_TRUE(has(RawClient(port()).get("/nothing?x=1"), "there is no /nothing\""));
  RawClient client(port());
  client.send("DELETE /hello HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n");
  EXPECT_TRUE(has(client.read_to_end(), "405 Method Not Allowed"));
}

TEST_F(ServerTest, ANameOfAnotherSiteIsRefused) {
  start();
  EXPECT_TRUE(has(RawClient(port()).get("/hello", "Host: evil.example\r\n"), "421 "));
  EXPECT_TRUE(has(RawClient(port()).get("/hello", ""), "421 ")) << "no name at all";
}

TEST_F(ServerTest, GarbageAndOversizedRequestsEndOnlyTheirConnection) {
  start({.header_bytes = 1000, .body_bytes = 1000});
  const auto answer_to = [&](const std::string& bytes) {
    RawClient client(port());
    client.send(bytes);
    return client.read_to_end();
  };
  EXPECT_TRUE(has(answer_to("\x16\x03\x01\x02 TLS?\r\n\r\n"), "400 Bad Request"));
  EXPECT_TRUE(has(answer_to("GET /" + std::string(5000, 'a') + " HTTP/1.1\r\n\r\n"), "431 "));
  EXPECT_TRUE(has(answer_to("POST /hello HTTP/1.1\r\nHost: localhost\r\nContent-Length: 100000\r\n\r\n"), "413 "));
  EXPECT_TRUE(has(answer_to("POST /hello HTTP/1.1\r\nHost: localhost\r\nContent-Length: x\r\n\r\n"), "400 "));
  EXPECT_TRUE(has(RawClient(port()).get("/hello"), "hello "));
  EXPECT_EQ(server_->counters().requests_broken, 4U);
}

TEST_F(ServerTest, ASlowRequestIsCutOffAndOthersDoNotWait) {
  start({.request = std::chrono::milliseconds(300)});
  RawClient slow(port());
  slow.send("GET /hello HTTP/1.1\r\nHo");
  EXPECT_TRUE(has(RawClient(port()).get("/hello"), "hello "));
  EXPECT_EQ(slow.read_to_end(), "");
  EXPECT_EQ(server_->counters().requests_broken, 1U);
}

TEST_F(ServerTest, AConnectionBeyondTheBoundTakesThePlaceOfTheOldest) {
  start({.connections = 3});
  RawClient half(port());
  half.send("GET /hello HTTP/1.1\r\nHo");
  WebSocketClient first(port(), "/echo"), second(port(), "/echo");
  EXPECT_EQ(first.read(), "welcome");
  EXPECT_EQ(second.read(), "welcome");
  WebSocketClient third(port(), "/echo");
  EXPECT_EQ(third.read(), "welcome");
  EXPECT_EQ(half.read_to_end(), "") << "a request that is not whole";
  EXPECT_EQ(server_->counters().connections_refused, 1U);
  EXPECT_TRUE(has(RawClient(port()).get("/hello"), "hello "));
  EXPECT_EQ(first.read(), "(closed)");
  second.send("still here");
  EXPECT_EQ(second.read(), "still here");
  EXPECT_TRUE(navcal::test::eventually([&] { return server_->in_loop([&] { return links_.size() == 2; }); }));
}

TEST_F(ServerTest, WhoHasShownTheTokenKeepsItsPlaceAndTheLastPlaceIsNobodysElse) {
  start({.connections = 2});
  WebSocketClient first(port(), "/echo");
  EXPECT_EQ(first.read(), "welcome");
  const auto show_token = [&] {
    return server_->in_loop([&] {
      for (PeerLink* link : links_) link->show_token();
      return links_.size();
    });
  };
  EXPECT_EQ(show_token(), 1U);
  for (int i = 0; i < 5; ++i) EXPECT_EQ(WebSocketClient(port(), "/echo").read(), "welcome") << i;
  WebSocketClient second(port(), "/echo");
  EXPECT_EQ(second.read(), "welcome");
  EXPECT_TRUE(navcal::test::eventually([&] { return show_token() == 2; }));
  EXPECT_EQ(RawClient(port()).get("/hello"), "") << "both places are kept";
  for (WebSocketClient* kept : {&first, &second}) {
    kept->send("still here");
    EXPECT_EQ(kept->read(), "still here");
  }
}

TEST_F(ServerTest, SubprotocolAndOriginDecideWhoMayConnect) {
  start();
  EXPECT_EQ(WebSocketClient(port(), "/echo").status(), 101U);
  const std::string own = "http://localhost:" + std::to_string(port());
  EXPECT_EQ(WebSocketClient(port(), "/echo", "", own).status(), 101U);
  EXPECT_EQ(WebSocketClient(port(), "/echo", "", "http://evil.example").status(), 403U);
  EXPECT_EQ(WebSocketClient(port(), "/echo", "a.v1").status(), 404U);
  const WebSocketClient open(port(), "/open", "x, b.v1, a.v1", "https://app.example");
  EXPECT_EQ(open.status(), 101U);
  EXPECT_EQ(open.subprotocol(), "b.v1");
  EXPECT_EQ(WebSocketClient(port(), "/open", "a.v1", "http://evil.example").status(), 403U);
}

TEST_F(ServerTest, MessagesGoBothWays) {
  start();
  WebSocketClient client(port(), "/echo");
  EXPECT_EQ(client.read(), "welcome");
  client.send("gr\xc3\xbc\xc3\x9f dich");
  EXPECT_EQ(client.read(), "gr\xc3\xbc\xc3\x9f dich");
  client.close();
  EXPECT_TRUE(navcal::test::eventually([&] { return server_->counters().web_sockets_open == 0; }));
  EXPECT_TRUE(server_->in_loop([&] { return links_.empty(); }));
}

TEST_F(ServerTest, BadUtf8AndOversizedMessagesEndOnlyTheirConnection) {
  start({.message_bytes = 1000});
  WebSocketClient stays(port(), "/echo");
  EXPECT_EQ(stays.read(), "welcome");
  for (const std::string& message : {std::string("\xff\xfe"), std::string(2000, 'x')}) {
    WebSocketClient client(port(), "/echo");
    EXPECT_EQ(client.read(), "welcome");
    client.send(message);
    EXPECT_EQ(client.read(), "(closed)");
  }
  stays.send("still here");
  EXPECT_EQ(stays.read(), "still here");
}

TEST_F(ServerTest, WhatAStalledClientMissesIsDroppedWholeAndNobodyWaits) {
  start({.queue_bytes = 1 << 20});
  WebSocketClient stalled(port(), "/echo", "", "", 4096);
  EXPECT_EQ(stalled.read(), "welcome");
  const auto shared = std::make_shared<const std::string>(100'000, 'x');
  const auto sent = server_->in_loop([&] {
    int taken = 0;
    for (int i = 0; i < 500; ++i) taken += (*links_.begin())->send({shared, false}) ? 1 : 0;
    return taken;
  });
  EXPECT_LT(sent, 500);
  EXPECT_GE(sent, 10);
  EXPECT_EQ(server_->counters().messages_dropped, static_cast<std::uint64_t>(500 - sent));
  EXPECT_TRUE(has(RawClient(port()).get("/hello"), "hello "));
  for (int i = 0; i < sent; ++i)
    ASSERT_EQ(stalled.read().size(), shared->size()) << "message " << i << " is whole";
}

TEST_F(ServerTest, ASilentStalledClientIsGivenUp) {
  start({.queue_bytes = 8 << 20, .silence = std::chrono::milliseconds(400)});
  WebSocketClient stalled(port(), "/echo", "", "", 4096);
  EXPECT_EQ(stalled.read(), "welcome");
  server_->in_loop([&] {
    return (*links_.begin())->send({std::make_shared<const std::string>(8'000'000, 'x'), false});
  });
  EXPECT_TRUE(navcal::test::eventually([&] { return server_->counters().web_sockets_open == 0; }));
}

TEST_F(ServerTest, ClientsAreToldWhenTheServerStops) {
  start();
  WebSocketClient client(port(), "/echo");
  EXPECT_EQ(client.read(), "welcome");
  server_->in_loop([&] {
    (*links_.begin())->send_text("last words");
    (*links_.begin())->close("time to go");
    return 0;
  });
  EXPECT_EQ(client.read(), "last words");
  EXPECT_EQ(client.read(), "(closed)");
  EXPECT_EQ(client.close_reason(), "time to go");
}

}  // namespace
}  // namespace navcal::web
