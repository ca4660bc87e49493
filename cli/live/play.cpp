// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/signal_set.hpp>
#include <cstdio>
#include <exception>

#include "base/interruptible.h"
#include "cli/live/commands.h"
#include "emulation/play_session.h"

namespace navcal::cli {
namespace {

namespace asio = boost::asio;

void run(const emulation::PlayArguments& arguments) {
  asio::io_context io{1};
  emulation::PlaySession session(io.get_executor(), arguments);
  bool interrupted = false;
  asio::signal_set signals(io);
  for (const int signal : base::ending_signals()) signals.add(signal);
  signals.async_wait([&](const boost::system::error_code& error, int) {
    if (error) return;
    interrupted = true;
    io.stop();
  });
  std::exception_ptr failure;
  asio::co_spawn(io, session.run(), [&](const std::exception_ptr& error) {
    failure = error;
    io.stop();
  });
  io.run();
  if (failure) std::rethrow_exception(failure);
  if (interrupted) fmt::print(stderr, "navcal play: interrupted\n");
  session.report();
}

}  // namespace

void add_play(CLI::App& app) {
  const auto [command, arguments] = add_command<emulation::PlayArguments>(
      app, "play", "play a recording into pseudo-terminals at its own pace", run);
  command->add_option("FILE", arguments->file)->required();
  command->add_option("--dir", arguments->dir)->required();
  add_number(command, "--speed", 0.001, 1e6, arguments->speed);
  add_number(command, "--wait", 0.0, 86400.0, arguments->wait_s);
}

}  // namespace navcal::cli
