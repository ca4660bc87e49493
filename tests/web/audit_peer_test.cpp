// SPDX-License-Identifier: Apache-2.0
// The way of a log to `navcal audit` and of its page back, with a script in that program's place.
#include "web/audit_peer.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/stat.h>

#include <chrono>
#include <fstream>
#include <thread>

#include "tests/support/temporary_folder.h"
#include "tests/web/web_server.h"

namespace navcal::web {
namespace {

using test::WebServer;
using test::WebSocketClient;

class AuditPeerTest : public testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directory(temporary());
    path_ = ::getenv("PATH");
    ::setenv("PATH", (folder_.path().string() + ":" + path_).c_str(), 1);
    ::setenv("TMPDIR", temporary().c_str(), 1);
    server_.site.add(audit_endpoint(server_.executor()));
    server_.start();
  }
  void TearDown() override {
    ::setenv("PATH", path_.c_str(), 1);
    ::unsetenv("TMPDIR");
  }
  /// `navcal audit --report PAGE FILE` in this test.
  void make_navcal(const std::string& script) const {
    const auto file = folder_.path() / "navcal";
    std::ofstream(file) << "#!/bin/sh\n" << script << "\n";
    ::chmod(file.c_str(), 0755);
  }
  [[nodiscard]] std::filesystem::path temporary() const { return folder_.path() / "temporary"; }
  [[nodiscard]] bool left_nothing() const {
    for (int i = 0; i < 500; ++i) {
      if (std::filesystem::is_empty(temporary())) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    return false;
  }
  static std::string next_but_progress(WebSocketClient& client) {
    for (;;) {
      std::string message = client.read();
      if (!message.starts_with(R"({"progress")")) return message;
    }
  }

  navcal::test::TemporaryFolder folder_;
  std::string path_;
  WebServer server_;
};

TEST_F(AuditPeerTest, TheLogGoesInAndThePageComesBack) {
  make_navcal(R"(printf '\rnavcal audit: reading, 40 %%\033[K' >&2
    { echo "$1 $2 $4"; cat "$4"; echo; echo "$TMPDIR"; nice; } >"$3")");
  WebSocketClient client(server_.port(), "/audit");
  client.send(R"({"name":"../a dive\u00e9.BIN","bytes":6})");
  EXPECT_EQ(client.read(), R"({"received":0})");
  client.send("abc", true);
  EXPECT_EQ(client.read(), R"({"received":3})");
  client.send("def", true);
  EXPECT_EQ(client.read(), R"({"received":6})");
  EXPECT_EQ(client.read(), R"({"progress":"navcal audit: reading, 40 %"})");
  const std::string page = client.read();
  EXPECT_TRUE(page.starts_with("audit --report ./a dive\u00e9.BIN\nabcdef\n" + temporary().string() + "/navcal-"))
      << page;
  EXPECT_TRUE(page.ends_with("\n10\n")) << "at low priority: " << page;
  EXPECT_EQ(client.read(), "(closed)");
  EXPECT_TRUE(left_nothing());
}

TEST_F(AuditPeerTest, WhatTheProgramSaysOfABadFileComesBack) {
  make_navcal("echo 'navcal: dive.BIN: no log that is known' >&2; exit 3");
  WebSocketClient client(server_.port(), "/audit");
  client.send(R"({"name":"dive.BIN","bytes":1})");
  EXPECT_EQ(client.read(), R"({"received":0})");
  client.send("x", true);
  EXPECT_EQ(client.read(), R"({"received":1})");
  EXPECT_EQ(next_but_progress(client), R"({"ok":false,"error":"navcal: dive.BIN: no log that is known"})");
  EXPECT_EQ(client.read(), "(closed)");
  EXPECT_TRUE(left_nothing());
}

TEST_F(AuditPeerTest, WhatIsNoLogIsRefused) {
  for (const std::string& first :
       {std::string("no JSON"), std::string("[]"), std::string("{}"), std::string(R"({"name":"a","bytes":-1})"),
        std::string(R"({"name":"a","bytes":0})"), std::string(R"({"name":"a","bytes":1073741825})")}) {
    WebSocketClient client(server_.port(), "/audit");
    client.send(first);
    EXPECT_NE(client.read().find("\"ok\":false"), std::string::npos) << first;
    EXPECT_EQ(client.read(), "(closed)") << first;
  }
  WebSocketClient without_name(server_.port(), "/audit");
  without_name.send("bytes", true);
  EXPECT_NE(without_name.read().find("\"ok\":false"), std::string::npos);
  WebSocketClient too_long(server_.port(), "/audit");
  too_long.send(R"({"name":"a","bytes":2})");
  EXPECT_EQ(too_long.read(), R"({"received":0})");
  too_long.send("abc", true);
  EXPECT_NE(too_long.read().find("more came"), std::string::npos);
  EXPECT_TRUE(left_nothing());
}

TEST_F(AuditPeerTest, TheAuditEndsWithItsClientAndAnotherMayBegin) {
  const auto number = folder_.path() / "pid";
  make_navcal("echo $$ >'" + number.string() + ".new'; mv '" + number.string() + ".new' '" + number.string() +
              "'; mkdir \"$TMPDIR/its own\"; sleep 600");
  auto client = std::make_unique<WebSocketClient>(server_.port(), "/audit");
  client->send(R"({"name":"a","bytes":1})");
  EXPECT_EQ(client->read(), R"({"received":0})");
  client->send("x", true);
  EXPECT_EQ(client->read(), R"({"received":1})");
  for (int i = 0; i < 500 && !std::filesystem::exists(number); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  pid_t pid = 0;
  std::ifstream(number) >> pid;
  ASSERT_GT(pid, 0);
  WebSocketClient second(server_.port(), "/audit");
  second.send(R"({"name":"b","bytes":1})");
  EXPECT_NE(second.read().find("another audit is running"), std::string::npos);
  client.reset();
  EXPECT_TRUE(left_nothing());
  EXPECT_EQ(::kill(pid, 0), -1);
  WebSocketClient third(server_.port(), "/audit");
  third.send(R"({"name":"b","bytes":1})");
  EXPECT_EQ(third.read(), R"({"received":0})");
}

TEST_F(AuditPeerTest, AForeignPageOrTheNameOfAProxyIsKeptOut) {
  WebSocketClient foreign(server_.port(), "/audit", {}, "https://evil.example");
  EXPECT_EQ(foreign.status(), 403U);
  // A known name of the vehicle, under which others reach it.
  WebSocketClient by_name(server_.port(), "/audit", {}, {}, 0, "vehicle.local");
  EXPECT_NE(by_name.read().find("on the same computer only"), std::string::npos);
  EXPECT_EQ(by_name.read(), "(closed)");
}

}  // namespace
}  // namespace navcal::web
