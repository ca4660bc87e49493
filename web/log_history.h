// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/asio/any_io_executor.hpp>
#include <boost/asio/awaitable.hpp>
#include <boost/asio/steady_timer.hpp>
#include <chrono>
#include <filesystem>
#include <memory>
#include <string>

#include "web/site.h"

namespace navcal::web {

/// The plots' last half hour from navcald's log, for a page that is opened late. Pieces of the newest logs are
/// read through the control socket, from the newest back, the further apart the older. Readers of the same time
/// share one reading, which is bounded in bytes and time.
class LogHistory {
 public:
  using Text = std::shared_ptr<const std::string>;

  /// `limit`: time for one reading; what it has until then is the answer.
  LogHistory(const boost::asio::any_io_executor& executor, std::filesystem::path control_socket,
             std::chrono::seconds limit = std::chrono::seconds(5));
  /// `{"problem":why or null,"records":[[topic,device,message],...]}`, in the order of their times.
  [[nodiscard]] boost::asio::awaitable<Text> json();

 private:
  boost::asio::awaitable<Text> read();

  std::filesystem::path control_socket_;
  std::chrono::seconds limit_;
  boost::asio::steady_timer done_;  ///< cancelled when a reading has ended
  bool is_reading_ = false;
  Text text_;
  std::chrono::steady_clock::time_point made_;
};

/// Adds `/history.json` to a site, which serves it as long as `history` lives.
void add_history(Site& site, LogHistory& history);

}  // namespace navcal::web
