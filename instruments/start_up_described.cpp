// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <string>
#include <vector>

#include "base/durations.h"
#include "instruments/devices.h"

namespace navcal::instruments {
namespace {

/// Devices that read their commands slowly lose what comes without a pause.
constexpr std::int64_t kPause_ns = base::kSecond_ns / 5;
/// So long without a frame, the device has lost its power or its settings.
constexpr std::int64_t kSilence_ns = 10 * base::kSecond_ns;

std::string sent_text(unsigned rounds) {
  return rounds == 1 ? "start-up lines sent" : fmt::format("start-up lines sent {} times, no frames", rounds);
}

/// Sends the start-up lines of a description, with a pause between them, and again when no frame of the device has
/// come for a while. Answers are not waited for: a description does not know them.
class StartUpDescribed final : public StartUp {
 public:
  explicit StartUpDescribed(std::vector<std::string> lines) : StartUp(kSending), lines_(std::move(lines)) {}

 private:
  Script script() override {
    const auto is_frame = [](const protocols::Frame&) { return true; };
    const auto bytes_of = [](const std::string& line) {
      return std::vector<std::uint8_t>(line.begin(), line.end());
    };
    enter(kSending);
    all_sent_ = false;
    for (unsigned rounds = 1;; ++rounds) {
      for (std::size_t i = 0; i + 1 < lines_.size(); ++i) co_await send(bytes_of(lines_[i]), kPause_ns);
      all_sent_ = true;
      enter(in_service() ? "running" : sent_text(rounds), in_service());
      bool frames_come = co_await ask(bytes_of(lines_.back()), 1, kSilence_ns, is_frame);
      while (frames_come) frames_come = co_await wait(kSilence_ns, is_frame);
      enter(sent_text(rounds));
    }
  }
  void on_any_frame(const protocols::Frame&) override { enter(all_sent_ ? "running" : kSending, true); }

  static constexpr const char* kSending = "sending the start-up lines";
  std::vector<std::string> lines_;
  bool all_sent_ = false;  ///< once
};

}  // namespace

std::unique_ptr<StartUp> start_described(const config::PortSettings& settings) {
  const bool has_lines = settings.described && !settings.described->start_up.empty();
  return has_lines ? std::make_unique<StartUpDescribed>(settings.described->start_up) : nullptr;
}

}  // namespace navcal::instruments
