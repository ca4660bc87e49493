// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/asio/any_io_executor.hpp>
#include <boost/asio/awaitable.hpp>
#include <boost/asio/steady_timer.hpp>
#include <filesystem>
#include <memory>
#include <vector>

#include "ports/pty_host.h"
#include "record/recording.h"

namespace navcal::emulation {

struct PlayArguments {
  std::filesystem::path file;
  std::filesystem::path dir;
  double speed = 1;
  double wait_s = 5;
};

/// A recording on its way into pseudo-terminals.
class PlaySession {
 public:
  /// Opens the file and makes the ports. Throws record::BadRecording, or what ports::PtyHost throws.
  PlaySession(const boost::asio::any_io_executor& executor, const PlayArguments& arguments);

  /// Says `ready`, waits for readers, plays to the end and leaves them time to take what they have been sent.
  boost::asio::awaitable<void> run();
  /// To standard error: what became of the bytes.
  void report() const;

 private:
  boost::asio::awaitable<void> wait_for_readers();
  boost::asio::awaitable<void> wait_until_read();
  boost::asio::awaitable<void> pause(std::chrono::nanoseconds duration);

  PlayArguments arguments_;
  std::unique_ptr<record::Recording> recording_;
  std::vector<std::unique_ptr<ports::PtyHost>> hosts_;
  boost::asio::steady_timer timer_;
};

}  // namespace navcal::emulation
