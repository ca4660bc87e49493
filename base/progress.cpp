// SPDX-License-Identifier: Apache-2.0
#include "base/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <utility>

#include "base/printable.h"

namespace navcal::base {
namespace {

constexpr std::chrono::milliseconds kFirst{1000};
constexpr std::chrono::milliseconds kInterval{200};
constexpr double kMegabyte = 1e6;

}  // namespace

Progress::Progress(std::string job, Answer answer)
    : job_(std::move(job)),
      enabled_(::isatty(STDERR_FILENO) == 1 && (answer == Answer::at_the_end || ::isatty(STDOUT_FILENO) == 0)),
      next_(std::chrono::steady_clock::now() + kFirst) {}

Progress::~Progress() {
  if (shown_) fmt::print(stderr, "\r\x1b[K");
}

void Progress::show(double share) {
  if (due()) print(fmt::format("{:.0f} %", 100 * share));
}

void Progress::show(std::string_view part, double share) {
  if (due()) print(fmt::format("{}, {:.0f} %", part, 100 * share));
}

void Progress::show_bytes(std::uint64_t done, std::optional<std::uint64_t> total) {
  if (!due()) return;
  std::string text = fmt::format("{:.0f} MB", static_cast<double>(done) / kMegabyte);
  if (total && *total > 0) {
    text += fmt::format(" of {:.0f}, {} %", static_cast<double>(*total) / kMegabyte, done * 100 / *total);
  }
  print(text);
}

bool Progress::due() {
  if (!enabled_) return false;
  const auto now = std::chrono::steady_clock::now();
  if (now < next_) return false;
  next_ = now + kInterval;
  return true;
}

void Progress::print(std::string_view text) {
  shown_ = true;
  fmt::print(stderr, "\rnavcal {}: {}\x1b[K", job_, base::printable(text));
  std::fflush(stderr);
}

}  // namespace navcal::base
