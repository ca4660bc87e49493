// SPDX-License-Identifier: Apache-2.0
#include "emulation/play_session.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/asio/use_awaitable.hpp>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <optional>

#include "base/printable.h"
#include "base/progress.h"

namespace navcal::emulation {
namespace {

namespace asio = boost::asio;
using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr milliseconds kLookAgain{20};
constexpr std::chrono::seconds kLongestReading{2};
constexpr milliseconds kGrace{50};  // for bytes that the kernel has still to hand from one end to the other

}  // namespace

PlaySession::PlaySession(const asio::any_io_executor& executor, const PlayArguments& arguments)
    : arguments_(arguments), recording_(record::Recording::open(arguments.file)), timer_(executor) {
  for (const config::PortSettings& port : recording_->settings().ports) {
    hosts_.push_back(
        std::make_unique<ports::PtyHost>(executor, arguments_.dir / port.name, port.baud, [](auto, auto) {}));
  }
  if (hosts_.empty()) throw record::BadRecording(arguments_.file.string() + ": has no ports");
}

asio::awaitable<void> PlaySession::pause(std::chrono::nanoseconds duration) {
  timer_.expires_after(duration);
  co_await timer_.async_wait(asio::use_awaitable);
}

asio::awaitable<void> PlaySession::wait_for_readers() {
  const auto until = steady_clock::now() + std::chrono::duration_cast<steady_clock::duration>(
                                               std::chrono::duration<double>(arguments_.wait_s));
  const auto opened = [](const auto& host) { return host->has_client(); };
  while (steady_clock::now() < until && !std::ranges::all_of(hosts_, opened)) co_await pause(kLookAgain);
  for (const auto& host : hosts_) {
    if (arguments_.wait_s > 0 && !host->has_client()) {
      fmt::print(stderr, "navcal play: starts although no program has opened {}\n", host->link().string());
    }
  }
}

asio::awaitable<void> PlaySession::run() {
  fmt::print("ready\n");
  std::fflush(stdout);
  co_await wait_for_readers();
  const auto start = steady_clock::now();
  std::optional<std::int64_t> first_ns;
  base::Progress progress("play");
  while (const auto entry = recording_->next()) {
    const auto* read = std::get_if<record::RawRead>(&*entry);
    if (read == nullptr || read->direction != record::Direction::received) continue;
    if (!first_ns) first_ns = read->time_ns;
    const double after_ns = static_cast<double>(read->time_ns - *first_ns) / arguments_.speed;
    timer_.expires_at(start + std::chrono::nanoseconds(std::llround(after_ns)));
    co_await timer_.async_wait(asio::use_awaitable);
    hosts_.at(read->port)->write(read->bytes);
    progress.show(recording_->progress());
  }
  co_await wait_until_read();
}

/// The hang-up at the end takes away what has not been read.
asio::awaitable<void> PlaySession::wait_until_read() {
  const auto until = steady_clock::now() + kLongestReading;
  const auto unread = [](const auto& host) { return host->unread() > 0; };
  do {
    co_await pause(kGrace);
  } while (std::ranges::any_of(hosts_, unread) && steady_clock::now() < until);
}

void PlaySession::report() const {
  for (const std::string& remark : recording_->remarks())
    fmt::print(stderr, "navcal play: {}\n", base::printable(remark));
  for (const auto& host : hosts_) {
    const auto& tally = host->tally();
    fmt::print(stderr, "{}: {} bytes taken", host->link().string(), tally.taken);
    if (tally.unheard > 0) fmt::print(stderr, ", {} lost because nobody had it open", tally.unheard);
    if (tally.overrun > 0) fmt::print(stderr, ", {} lost because the reader did not keep up", tally.overrun);
    fmt::print(stderr, "\n");
  }
}

}  // namespace navcal::emulation
