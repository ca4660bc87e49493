// SPDX-License-Identifier: Apache-2.0
#include "web/control_peer.h"

#include <gtest/gtest.h>
#include <sys/un.h>

#include "base/descriptor.h"
#include "tests/support/process.h"
#include "tests/support/temporary_folder.h"
#include "tests/web/web_server.h"

namespace navcal::web {
namespace {

using test::WebServer;
using test::WebSocketClient;

const std::string kSecret = "a token of many characters";

/// A control socket of navcald's kind, served by the test.
class FakeControl {
 public:
  explicit FakeControl(const std::filesystem::path& path) : listening_(::socket(AF_UNIX, SOCK_STREAM, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    path.string().copy(address.sun_path, sizeof address.sun_path - 1);
    ::bind(listening_.get(), reinterpret_cast<sockaddr*>(&address), sizeof address);
    ::listen(listening_.get(), 8);
  }
  void accept() { client_ = base::Descriptor(::accept(listening_.get(), nullptr, nullptr)); }
  /// Bytes up to the next line end; "(closed)" when the client has gone.
  std::string line() {
    std::string got;
    char c = 0;
    while (::read(client_.get(), &c, 1) == 1) {
      if (c == '\n') return got;
      got += c;
    }
    return "(closed)";
  }
  void answer(std::string_view text) { EXPECT_GT(::write(client_.get(), text.data(), text.size()), 0); }
  void hang_up() { client_ = base::Descriptor(); }

 private:
  base::Descriptor listening_, client_;
};

class ControlPeerTest : public testing::Test {
 protected:
  void SetUp() override {
    server_.site.add(
        control_endpoint(server_.executor(), "/control", folder_.path() / "control", server_.access()));
    server_.start();
  }
  [[nodiscard]] static std::string token(const std::string& text) { return R"({"token":")" + text + "\"}"; }

  navcal::test::TemporaryFolder folder_;
  WebServer server_{{}, kSecret};
};

TEST_F(ControlPeerTest, OnlyTheTokenOpensTheWay) {
  FakeControl control(folder_.path() / "control");
  for (const std::string& first : {token("wrong"), std::string("no JSON"), std::string("[]"), std::string("{}"),
                                   std::string(R"({"token":5})"), std::string(R"({"command":"motor.lease"})")}) {
    WebSocketClient client(server_.port(), "/control");
    client.send(first);
    EXPECT_NE(client.read().find("\"ok\":false"), std::string::npos) << first;
    EXPECT_EQ(client.read(), "(closed)") << first;
  }
}

TEST_F(ControlPeerTest, RequestsAndAnswersPassUnchanged) {
  FakeControl control(folder_.path() / "control");
  WebSocketClient client(server_.port(), "/control");
  client.send(token(kSecret));
  EXPECT_EQ(client.read(), R"({"ok":true})");
  control.accept();
  client.send(R"({"command":"event","text":"x"})");
  EXPECT_EQ(control.line(), R"({"command":"event","text":"x"})");
  control.answer("{\"ok\":true,\"n\":1}\n{\"ok\":false}\n");
  EXPECT_EQ(client.read(), R"({"ok":true,"n":1})");
  EXPECT_EQ(client.read(), R"({"ok":false})");
}

TEST_F(ControlPeerTest, TheConnectionToNavcaldEndsWithTheClient) {
  FakeControl control(folder_.path() / "control");
  {
    WebSocketClient client(server_.port(), "/control");
    client.send(token(kSecret));
    EXPECT_EQ(client.read(), R"({"ok":true})");
    control.accept();
  }
  EXPECT_EQ(control.line(), "(closed)") << "a lease of the motor ends by that";
}

TEST_F(ControlPeerTest, NeitherViewersNorHalfRequestsLockTheOperatorOut) {
  constexpr std::size_t kPlaces = 16;
  WebServer server({.connections = kPlaces}, kSecret);
  server.site.add(control_endpoint(server.executor(), "/control", folder_.path() / "control", server.access()));
  WebSocketEndpoint live;
  live.path = "/live";
  struct Silent final : Peer {
    void on_open() override {}
    void on_text(std::string_view) override {}
  };
  live.make_peer = [](PeerLink&, std::string_view) { return std::make_unique<Silent>(); };
  server.site.add(live);
  server.start();
  FakeControl control(folder_.path() / "control");
  WebSocketClient early(server.port(), "/control");
  early.send(token(kSecret));
  EXPECT_EQ(early.read(), R"({"ok":true})");
  control.accept();
  std::vector<std::unique_ptr<WebSocketClient>> viewers;
  std::vector<std::unique_ptr<test::RawClient>> halves;
  for (std::size_t i = 0; i < 2 * kPlaces; ++i) {
    viewers.push_back(std::make_unique<WebSocketClient>(server.port(), i % 2 == 0 ? "/live" : "/control"));
    EXPECT_EQ(viewers.back()->status(), 101U) << i;
    halves.push_back(std::make_unique<test::RawClient>(server.port()));
    halves.back()->send("GET /control HTTP/1.1\r\nHo");
  }
  early.send("{}");
  EXPECT_EQ(control.line(), "{}") << "who had shown the token before";
  WebSocketClient late(server.port(), "/control");
  late.send(token(kSecret));
  EXPECT_EQ(late.read(), R"({"ok":true})");
  control.accept();
  late.send(R"({"command":"motor.stop"})");
  EXPECT_EQ(control.line(), R"({"command":"motor.stop"})");
}

TEST_F(ControlPeerTest, TwoLinesInOneMessageAndOverlongOnesAreRefused) {
  FakeControl control(folder_.path() / "control");
  WebSocketClient client(server_.port(), "/control");
  client.send(token(kSecret));
  EXPECT_EQ(client.read(), R"({"ok":true})");
  control.accept();
  client.send("{}\n{}");
  EXPECT_NE(client.read().find("one line"), std::string::npos);
  client.send(std::string(5000, ' '));
  EXPECT_NE(client.read().find("one line"), std::string::npos);
  client.send("{}");
  EXPECT_EQ(control.line(), "{}") << "nothing of the refused messages was passed on";
}

TEST_F(ControlPeerTest, NavcaldGoneIsToldWithTheReason) {
  {
    WebSocketClient client(server_.port(), "/control");
    client.send(token(kSecret));
    EXPECT_EQ(client.read(), R"({"ok":true})");
    EXPECT_NE(client.read().find("control socket"), std::string::npos);
    EXPECT_EQ(client.read(), "(closed)");
  }
  FakeControl control(folder_.path() / "control");
  WebSocketClient client(server_.port(), "/control");
  client.send(token(kSecret));
  EXPECT_EQ(client.read(), R"({"ok":true})");
  control.accept();
  control.hang_up();
  EXPECT_NE(client.read().find("navcald closed"), std::string::npos);
  EXPECT_EQ(client.read(), "(closed)");
}

}  // namespace
}  // namespace navcal::web
