#include "cli/decode_progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace navcal::cli {
namespace {

constexpr std::chrono::milliseconds kFirst{1000};
constexpr std::chrono::milliseconds kInterval{200};
constexpr double kMegabyte = 1e6;

}  // namespace

Progress::Progress(std::optional<std::uint64_t> total_bytes)
    : total_(total_bytes),
      enabled_(::isatty(STDERR_FILENO) == 1 && ::isatty(STDOUT_FILENO) == 0),
      next_(std::chrono::steady_clock::now() + kFirst) {}

Progress::~Progress() {
  if (shown_) fmt::print(stderr, "\r\x1b[K");
}

void Progress::advance(std::uint64_t bytes) {
  done_ += bytes;
  if (!enabled_) return;
  const auto now = std::chrono::steady_clock::now();
  if (now < next_) return;
  next_ = now + kInterval;
  shown_ = true;
  fmt::print(stderr, "\rnavcal decode: {:.0f} MB", static_cast<double>(done_) / kMegabyte);
  if (total_ && *total_ > 0) {
    fmt::print(stderr, " of {:.0f}, {} %", static_cast<double>(*total_) / kMegabyte, done_ * 100 / *total_);
  }
  std::fflush(stderr);
}

}  // namespace navcal::cli
