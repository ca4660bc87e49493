// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/descriptor.h"

namespace navcal::cli::test {

/// A run of the navcal program with its standard input and outputs in our hands; ended by its id if it still runs.
class Program {
 public:
  explicit Program(std::vector<std::string> arguments);
  ~Program();

  /// Waits for a whole line of standard output; empty when the program ends without one.
  std::string line();
  void type(std::string_view text);
  void interrupt();
  /// Waits for its end; the exit status, or -1 when a signal ended it.
  int wait();
  /// All of standard error; after wait().
  std::string errors();

 private:
  pid_t pid_ = -1;
  base::Descriptor input_, output_, errors_;
};

/// A client's end of a line, at the speed at which the line was made.
class Client {
 public:
  explicit Client(const std::filesystem::path& port);
  void set_speed(int baud) const;
  void write(std::string_view text) const;
  /// Reads until `wanted` occurs, the line hangs up, or the time is over; all that was read so far.
  const std::string& read_until(std::string_view wanted,
                                std::chrono::milliseconds limit = std::chrono::seconds(20));
  /// Reads to the hang-up.
  const std::string& read_all();
  [[nodiscard]] bool hung_up() const { return hung_up_; }

 private:
  bool read_some();

  base::Descriptor fd_;
  std::string read_;
  bool hung_up_ = false;
};

}  // namespace navcal::cli::test
