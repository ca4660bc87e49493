#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

namespace navcal::cli {

/// How far a long job has come, on a terminal's standard error; silent when there is none, when standard output
/// goes to the same place, and for jobs of less than a second.
class Progress {
 public:
  explicit Progress(std::optional<std::uint64_t> total_bytes);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void advance(std::uint64_t bytes);

 private:
  std::optional<std::uint64_t> total_;
  std::uint64_t done_ = 0;
  bool shown_ = false;
  bool enabled_;
  std::chrono::steady_clock::time_point next_;
};

}  // namespace navcal::cli
