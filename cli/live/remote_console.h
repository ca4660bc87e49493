// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "cli/live/remote_operator.h"

namespace navcal::cli {

/// Lines that a person types, and the picture of the vehicle above them. With `json` everything is printed as
/// lines of JSON, without a terminal as plain lines.
class RemoteConsole {
 public:
  enum class Picture { terminal, lines, json };
  RemoteConsole(RemoteOperator& remote, Picture picture);
  ~RemoteConsole();
  RemoteConsole(const RemoteConsole&) = delete;
  RemoteConsole& operator=(const RemoteConsole&) = delete;

  /// A typed line. False: it ends the program.
  [[nodiscard]] bool take(std::string_view line);
  /// Prints what has come: reports, answers, responses.
  void show();
  void say(std::string_view words);

 private:
  /// At once. A terminal that is gone is seen by std::ferror: it keeps nobody from giving the lease back.
  static void put(const std::string& text);
  void show_report(const link::Host::NewReport& report);
  [[nodiscard]] bool give_order(std::string_view line);

  RemoteOperator& remote_;
  Picture picture_;
  RemoteOperator::Clock::time_point next_line_{};
};

}  // namespace navcal::cli
