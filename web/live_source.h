// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/asio/any_io_executor.hpp>
#include <boost/asio/awaitable.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "web/hub.h"

namespace navcal::web {

/// Feeds the hub from the status socket of a navcald. It connects again by itself, and asks only for what the
/// hub's subscribers need.
class LiveSource : public std::enable_shared_from_this<LiveSource> {
 public:
  struct Settings {
    std::string host = "127.0.0.1";
    std::string port = "2947";
  };
  struct Counters {
    std::uint64_t connections = 0;
    std::uint64_t lines = 0;
    std::uint64_t not_understood = 0;  ///< lines that are neither a record nor another class of navcald
    std::uint64_t missed = 0;          ///< reports that navcald dropped because this program was too slow
  };

  LiveSource(const boost::asio::any_io_executor& executor, Settings settings, Hub& hub);
  void start();
  void stop();
  [[nodiscard]] const Counters& counters() const { return counters_; }

 private:
  boost::asio::awaitable<void> run();
  boost::asio::awaitable<std::string> connect();
  boost::asio::awaitable<std::string> read_lines();
  /// Asks for what the subscribers need, if that has changed.
  void ask();
  void take(std::string_view line);
  void take_topics(std::string_view line);
  void take_health(std::string_view line);

  Settings settings_;
  Hub& hub_;
  boost::asio::ip::tcp::socket socket_;
  boost::asio::steady_timer pause_;
  boost::asio::steady_timer silence_;  ///< expires when navcald has said nothing for too long
  std::string asked_, request_;  ///< the policy in force, so that it is not sent twice; with what is before it
  bool is_answer_due_ =
      false;  ///< to the policy: a viewer that subscribes to twenty topics needs one more, not twenty
  std::vector<Topic> topics_;
  Counters counters_;
  bool silent_ = false;  ///< the limit of silence ended the connection
  bool stopped_ = false;
};

/// "localhost:2947", "[::1]:2947"; nullopt without a port.
[[nodiscard]] std::optional<LiveSource::Settings> status_socket(std::string_view text);

}  // namespace navcal::web
