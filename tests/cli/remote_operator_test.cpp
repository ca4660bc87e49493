// SPDX-License-Identifier: Apache-2.0
// The operator's side of the link, against a vehicle that is older than STOP.
#include "cli/remote_operator.h"

#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <thread>
#include <vector>

#include "base/descriptor.h"
#include "link/vehicle.h"

namespace navcal::cli {
namespace {

using Kind = link::Command::Kind;

/// Drops a stop without an answer, and does not say in its PONG which commands it knows.
class OldVehicle {
 public:
  OldVehicle() : listener_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in here{};
    here.sin_family = AF_INET;
    here.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t length = sizeof here;
    ::bind(listener_.get(), reinterpret_cast<sockaddr*>(&here), length);
    ::listen(listener_.get(), 1);
    ::getsockname(listener_.get(), reinterpret_cast<sockaddr*>(&here), &length);
    address = "tcp:127.0.0.1:" + std::to_string(ntohs(here.sin_port));
    thread_ = std::thread([this] { serve(); });
  }
  ~OldVehicle() {
    is_over_ = true;
    thread_.join();
  }
  OldVehicle(const OldVehicle&) = delete;
  OldVehicle& operator=(const OldVehicle&) = delete;
  /// What it was asked for; it is over then.
  std::vector<Kind> end() {
    is_over_ = true;
    while (!is_done_) std::this_thread::yield();
    return kinds_;
  }

  std::string address;

 private:
  static std::int64_t now_ns() {
    return std::chrono::nanoseconds(std::chrono::steady_clock::now().time_since_epoch()).count();
  }
  void serve() {
    const base::Descriptor client(::accept(listener_.get(), nullptr, nullptr));
    link::Vehicle vehicle{link::EndOptions{}};
    link::Parser parser;
    while (!is_over_) {
      pollfd readable{client.get(), POLLIN, 0};
      std::array<std::uint8_t, 4096> bytes{};
      const ssize_t n = ::poll(&readable, 1, 5) > 0 ? ::read(client.get(), bytes.data(), bytes.size()) : 0;
      parser.feed({bytes.data(), static_cast<std::size_t>(std::max<ssize_t>(n, 0))},
                  [&](const protocols::Frame& frame) {
                    const auto view = link::view_frame(frame.bytes);
                    if (view->header.type == link::FrameType::command &&
                        link::decode_command(view->payload)->kind == Kind::stop)
                      return;
                    vehicle.take(now_ns(), frame.bytes);
                  });
      vehicle.advance(now_ns());
      if (const auto command = vehicle.take_command()) {
        if (command->kind != Kind::order) kinds_.push_back(command->kind);
        vehicle.answer({command->number, true, false, "", command->kind != Kind::release});
      }
      while (auto frame = vehicle.next(now_ns())) send(client.get(), std::move(*frame));
    }
    is_done_ = true;
  }
  static void send(int client, link::Buffer frame) {
    const auto view = link::view_frame(frame);
    if (view->header.type == link::FrameType::pong)
      frame = link::FrameWriter(view->header, view->payload.first(5)).finish({});
    EXPECT_EQ(::send(client, frame.data(), frame.size(), MSG_NOSIGNAL), static_cast<ssize_t>(frame.size()));
  }

  base::Descriptor listener_;
  std::vector<Kind> kinds_;
  std::atomic<bool> is_over_{false}, is_done_{false};
  std::thread thread_;
};

std::optional<std::string> next_answer(RemoteOperator& remote) {
  std::optional<std::string> answer;
  const auto until = RemoteOperator::after(60);
  while (!(answer = remote.take_answer()) && RemoteOperator::Clock::now() < until) remote.work(until);
  return answer;
}

TEST(RemoteOperator, AStopThatAnOldVehicleDoesNotKnowBecomesALeaseAndItsRelease) {
  OldVehicle vehicle;
  RemoteOperator remote({.address = vehicle.address, .key_file = {}});
  remote.wait_for_session(60);
  remote.stop();
  EXPECT_EQ(next_answer(remote), "ok");
  EXPECT_FALSE(remote.is_in_charge());
  EXPECT_EQ(vehicle.end(), (std::vector{Kind::lease, Kind::release}));
}

TEST(RemoteOperator, TheHolderOfALeaseStopsAnOldVehicleByGivingItBack) {
  OldVehicle vehicle;
  RemoteOperator remote({.address = vehicle.address, .key_file = {}});
  remote.wait_for_session(60);
  remote.lease();
  EXPECT_EQ(next_answer(remote), "ok");
  const auto until = RemoteOperator::after(60);
  while (remote.host().knows(Kind::stop) && RemoteOperator::Clock::now() < until) remote.work(until);
  remote.stop();
  EXPECT_EQ(next_answer(remote), "ok");
  EXPECT_FALSE(remote.is_in_charge());
  EXPECT_EQ(vehicle.end(), (std::vector{Kind::lease, Kind::release}));
}

}  // namespace
}  // namespace navcal::cli
