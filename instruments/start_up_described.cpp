// SPDX-License-Identifier: Apache-2.0
#include <string>
#include <vector>

#include "base/durations.h"
#include "instruments/start_ups.h"

namespace navcal::instruments {
namespace {

/// Devices that read their commands slowly lose what comes without a pause.
constexpr std::int64_t kPause_ns = base::kSecond_ns / 5;
/// So long without a frame, the device has lost its power or its settings.
constexpr std::int64_t kSilence_ns = 10 * base::kSecond_ns;

/// Sends the start-up lines of a description, with a pause between them, and again when no frame of the device has
/// come for a while. Answers are not waited for: a description does not know them.
class StartUpDescribed final : public StartUp {
 public:
  explicit StartUpDescribed(std::vector<std::string> lines) : lines_(std::move(lines)) {}

  void begin(std::int64_t now_ns) override;
  void on_frame(const protocols::Frame& frame, std::int64_t now_ns) override;
  std::optional<std::vector<std::uint8_t>> next(std::int64_t now_ns) override;
  [[nodiscard]] bool in_service() const override { return frames_came_; }
  [[nodiscard]] std::string state() const override;

 private:
  std::vector<std::string> lines_;
  std::size_t sent_ = 0;      ///< lines of this round
  bool frames_came_ = false;  ///< since the last round
  unsigned rounds_ = 0;
};

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

std::unique_ptr<StartUp> start_described(const config::PortSettings& settings) {
  const bool has_lines = settings.described && !settings.described->start_up.empty();
  return has_lines ? std::make_unique<StartUpDescribed>(settings.described->start_up) : nullptr;
}

}  // namespace navcal::instruments
