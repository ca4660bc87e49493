// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace navcal::base {

/// How far a long job has come, on a terminal's standard error; silent when there is none, for jobs of less than a
/// second, and when standard output is a terminal and is written to meanwhile.
class Progress {
 public:
  enum class Answer { meanwhile, at_the_end };
  explicit Progress(std::string job, Answer answer = Answer::meanwhile);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// 0 to 1 of the whole.
  void show(double share);
  /// Shows the progress of a job in parts, with the current part.
  void show(std::string_view part, double share);
  /// Shows the progress over an input whose length may be unknown.
  void show_bytes(std::uint64_t done, std::optional<std::uint64_t> total);

 private:
  [[nodiscard]] bool due();
  void print(std::string_view text);

  std::string job_;
  bool shown_ = false;
  bool enabled_;
  std::chrono::steady_clock::time_point next_;
};

}  // namespace navcal::base
