// SPDX-License-Identifier: Apache-2.0
#include "instruments/start_up_described.h"

#include "base/durations.h"

namespace navcal::instruments {
namespace {

/// Devices that read their commands slowly lose what comes without a pause.
constexpr std::int64_t kPause_ns = base::kSecond_ns / 5;
/// So long without a frame, the device has lost its power or its settings.
constexpr std::int64_t kSilence_ns = 10 * base::kSecond_ns;

}  // namespace

void StartUpDescribed::begin(std::int64_t now_ns) {
  sent_ = 0;
  rounds_ = 0;
  frames_came_ = false;
  due_ns_ = now_ns;
}

void StartUpDescribed::on_frame(const protocols::Frame& /*frame*/, std::int64_t now_ns) {
  frames_came_ = true;
  if (sent_ == lines_.size()) due_ns_ = now_ns + kSilence_ns;
}

std::optional<std::vector<std::uint8_t>> StartUpDescribed::next(std::int64_t now_ns) {
  if (now_ns < due_ns_ || lines_.empty()) return std::nullopt;
  if (sent_ == lines_.size()) {
    sent_ = 0;
    frames_came_ = false;
  }
  const std::string& line = lines_[sent_++];
  const bool is_last = sent_ == lines_.size();
  if (is_last) ++rounds_;
  due_ns_ = now_ns + (is_last ? kSilence_ns : kPause_ns);
  return std::vector<std::uint8_t>(line.begin(), line.end());
}

std::string StartUpDescribed::state() const {
  if (rounds_ == 0) return "sending the start-up lines";
  if (frames_came_) return "running";
  return rounds_ == 1 ? "start-up lines sent"
                      : "start-up lines sent " + std::to_string(rounds_) + " times, no frames";
}

}  // namespace navcal::instruments
