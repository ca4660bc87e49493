// SPDX-License-Identifier: Apache-2.0
#include "web/log_history.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/un.h>

#include <atomic>
#include <map>
#include <nlohmann/json.hpp>
#include <thread>

#include "base/descriptor.h"
#include "record/json/base64.h"
#include "record/log/checksum.h"
#include "tests/support/temporary_folder.h"
#include "tests/web/web_server.h"

namespace navcal::web {
namespace {

using Json = nlohmann::json;
using test::RawClient;
using test::WebServer;

constexpr double kBegin_s = 1'700'000'000;
constexpr double kInterval_s = 0.1;
constexpr std::size_t kBlock_bytes = 2000;

/// A log of NAV every 0.1 s between other bytes. Every second message has a wrong checksum and a depth of -1.
std::string log_of(double begin_s, double span_s) {
  std::string log;
  for (int i = 0; i * kInterval_s < span_s; ++i) {
    const bool is_damaged = i % 2 == 1;
    const std::string message = fmt::format(R"({{"class":"NAV","time":{:.9f},"device":"navigation","depth_m":{})",
                                            begin_s + i * kInterval_s, is_damaged ? -1 : 2);
    log += message + fmt::format(R"(,"crc":"{:08x}"}})", record::crc32c(message) + (is_damaged ? 1 : 0));
    log.resize(static_cast<std::size_t>(i + 1) * kBlock_bytes, '\x7f');
  }
  return log;
}

/// navcald's control socket, as far as logs are listed and read: one connection after the other.
class LogServer {
 public:
  LogServer(const std::filesystem::path& path, std::map<std::string, std::string> logs)
      : logs_(std::move(logs)), listening_(::socket(AF_UNIX, SOCK_STREAM, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    path.string().copy(address.sun_path, sizeof address.sun_path - 1);
    ::bind(listening_.get(), reinterpret_cast<sockaddr*>(&address), sizeof address);
    ::listen(listening_.get(), 8);
    thread_ = std::thread([this] {
      for (;;) {
        const base::Descriptor client(::accept(listening_.get(), nullptr, nullptr));
        if (!client) return;
        serve(client.get());
      }
    });
  }
  ~LogServer() {
    ::shutdown(listening_.get(), SHUT_RDWR);
    thread_.join();
  }
  LogServer(const LogServer&) = delete;
  LogServer& operator=(const LogServer&) = delete;

  std::atomic<int> reads = 0;

 private:
  void serve(int client) {
    std::string line;
    for (char c = 0; ::read(client, &c, 1) == 1;) {
      if (c != '\n') {
        line += c;
        continue;
      }
      const std::string text = answer(Json::parse(line)).dump() + "\n";
      for (std::size_t sent = 0; sent < text.size();) {
        const ssize_t n = ::send(client, text.data() + sent, text.size() - sent, MSG_NOSIGNAL);
        if (n <= 0) return;
        sent += static_cast<std::size_t>(n);
      }
      line.clear();
    }
  }
  Json answer(const Json& request) {
    if (request["command"] == "log.list") {
      // One in each answer.
      const auto log = logs_.upper_bound(request["after"].get<std::string>());
      Json files = Json::array();
      if (log != logs_.end()) files.push_back({{"name", log->first}, {"bytes", log->second.size()}});
      return {{"ok", true}, {"files", files}, {"more", log != logs_.end() && std::next(log) != logs_.end()}};
    }
    ++reads;
    const std::string& log = logs_.at(request["file"].get<std::string>());
    return {{"ok", true},
            {"data", record::base64(
                         log.substr(request["offset"].get<std::size_t>(), request["length"].get<std::size_t>()))}};
  }

  std::map<std::string, std::string> logs_;
  base::Descriptor listening_;
  std::thread thread_;
};

class LogHistoryTest : public testing::Test {
 protected:
  void SetUp() override {
    add_history(server_.site, history_);
    server_.start();
  }
  Json get() {
    const std::string answer = RawClient(server_.port()).get("/history.json");
    return Json::parse(answer.substr(answer.find("\r\n\r\n") + 4));
  }

  navcal::test::TemporaryFolder folder_;
  WebServer server_;
  // Not the five seconds of the product: a test does not depend on the speed of the machine.
  LogHistory history_{server_.executor(), folder_.path() / "control", std::chrono::minutes(2)};
};

TEST_F(LogHistoryTest, CoversHalfAnHourOverTwoLogsWithinItsBounds) {
  LogServer navcald(folder_.path() / "control",
                    {{"1", log_of(kBegin_s, 1500)}, {"2", log_of(kBegin_s + 1500, 1500)}});
  const Json history = get();
  EXPECT_TRUE(history["problem"].is_null());
  std::vector<double> times;
  for (const auto& row : history["records"]) {
    EXPECT_EQ(row[0], "/nav");
    EXPECT_EQ(row[1], "navigation");
    EXPECT_EQ(row[2]["depth_m"], 2) << "a message with a wrong checksum was taken";
    times.push_back(row[2]["time"].get<double>());
  }
  ASSERT_GT(times.size(), 100U);
  // A piece is 3.3 s here.
  EXPECT_NEAR(times.back(), kBegin_s + 3000, 5);
  EXPECT_NEAR(times.front(), kBegin_s + 1200, 15);
  for (std::size_t i = 1; i < times.size(); ++i) {
    EXPECT_GT(times[i], times[i - 1]);
    EXPECT_LT(times[i] - times[i - 1], 10)
        << "the plots show a gap, " << times[i] - kBegin_s << " s from the begin";
  }
  EXPECT_LE(navcald.reads.load(), 300);
  const int reads = navcald.reads.load();
  EXPECT_EQ(get(), history);
  EXPECT_EQ(navcald.reads.load(), reads) << "a reading serves those who come soon after";
}

TEST_F(LogHistoryTest, SaysWhyThereIsNone) {
  const Json history = get();
  EXPECT_EQ(history["records"], Json::array());
  EXPECT_NE(history["problem"].get<std::string>().find("control: No such file"), std::string::npos) << history;
}

TEST_F(LogHistoryTest, NoLogIsNoProblem) {
  LogServer navcald(folder_.path() / "control", {});
  EXPECT_EQ(get(), (Json{{"problem", nullptr}, {"records", Json::array()}}));
}

}  // namespace
}  // namespace navcal::web
