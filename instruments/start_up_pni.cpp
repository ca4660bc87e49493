// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "base/durations.h"
#include "instruments/start_ups.h"
#include "protocols/trax.h"

namespace navcal::instruments {
namespace {

namespace trax = protocols::trax;

constexpr std::int64_t kPniAnswer_ns = 500 * base::kMillisecond_ns;
/// After a command without an answer: the time in which the device carries it out.
constexpr std::int64_t kPniObeys_ns = 50 * base::kMillisecond_ns;
constexpr int kPniAttempts = 3;
constexpr std::int64_t kPniStopped_ns = 3 * base::kSecond_ns;
constexpr std::int64_t kPniRest_ns = 10 * base::kSecond_ns;
constexpr double kUsualPniRate_Hz = 10;

constexpr trax::Component kComponents[] = {
    trax::Component::heading,        trax::Component::pitch,          trax::Component::roll,
    trax::Component::field_x,        trax::Component::field_y,        trax::Component::field_z,
    trax::Component::acceleration_x, trax::Component::acceleration_y, trax::Component::acceleration_z,
    trax::Component::temperature,    trax::Component::distortion};

constexpr std::uint8_t number_of(trax::FrameNumber number) { return static_cast<std::uint8_t>(number); }

/// PNI TRAX, TCM3 and Prime (ICD section 11): stops the output, asks who is there, sets magnetic north, degrees
/// and byte order, the interval and the components, and starts continuous output. A device that sends nothing then
/// is polled. Nothing is saved in the device. Begins anew when the data stop.
class StartUpPni final : public StartUp {
 public:
  explicit StartUpPni(const config::PortSettings& settings);

  void begin(std::int64_t now_ns) override;
  void on_frame(const protocols::Frame& frame, std::int64_t now_ns) override;
  std::optional<std::vector<std::uint8_t>> next(std::int64_t now_ns) override;
  [[nodiscard]] bool in_service() const override { return phase_ == Phase::running; }
  [[nodiscard]] std::string state() const override;

 private:
  enum class Phase : std::uint8_t {
    idle,           ///< begin() has not been called
    configuring,    ///< commands_[current_] is to be sent or waits for its answer
    awaiting_data,  ///< continuous output was started
    running,
    resting,  ///< no answer; all is repeated at due_ns_
  };
  struct Command {
    std::vector<std::uint8_t> bytes;
    std::uint8_t answer = 0;  ///< number of the frame that answers it; 0: none does
    std::string_view name{};
  };
  [[nodiscard]] std::vector<Command> commands() const;
  void go_on(std::int64_t now_ns);
  void start(bool polled, std::int64_t now_ns);

  double rate_Hz_;
  std::int64_t stopped_after_ns_;
  std::vector<Command> commands_;
  Phase phase_ = Phase::idle;
  bool polled_ = false;
  std::int64_t data_ns_ = 0;  ///< the newest came, or was first waited for
  std::size_t current_ = 0;
  int attempts_ = 0;
  unsigned fruitless_ = 0;
  std::string unanswered_;  ///< for people
};

}  // namespace

StartUpPni::StartUpPni(const config::PortSettings& settings)
    : rate_Hz_(settings.rate_Hz > 0 ? settings.rate_Hz : kUsualPniRate_Hz),
      stopped_after_ns_(std::max(kPniStopped_ns, static_cast<std::int64_t>(3e9 / rate_Hz_))) {}

/// The first command also ends a frame that was cut off: the device has no other sign of where one begins.
std::vector<StartUpPni::Command> StartUpPni::commands() const {
  using trax::FrameNumber;
  using trax::Setting;
  constexpr auto kDone = number_of(FrameNumber::set_config_done);
  std::vector<Command> commands{
      {trax::encode_frame(FrameNumber::stop_continuous), 0, "stop"},
      {trax::encode_frame(FrameNumber::get_module_info), number_of(FrameNumber::module_info), "GetModInfo"},
      {trax::encode_setting(Setting::true_north, 0), kDone, "magnetic north"},
      {trax::encode_setting(Setting::mils, 0), kDone, "degrees"},
      {trax::encode_setting(Setting::big_endian, 1), kDone, "byte order"},
      {trax::encode_acquisition({polled_, polled_ ? 0 : 1 / rate_Hz_}), number_of(FrameNumber::acquisition_done),
       "acquisition"},
      {trax::encode_components(kComponents), 0, "components"}};
  if (!polled_) commands.push_back({trax::encode_frame(FrameNumber::start_continuous), 0, "start"});
  return commands;
}

void StartUpPni::begin(std::int64_t now_ns) { start(false, now_ns); }

void StartUpPni::start(bool polled, std::int64_t now_ns) {
  polled_ = polled;
  commands_ = commands();
  phase_ = Phase::configuring;
  current_ = 0;
  attempts_ = 0;
  due_ns_ = now_ns;
  unanswered_.clear();
}

void StartUpPni::on_frame(const protocols::Frame& frame, std::int64_t now_ns) {
  if (frame.bytes.size() < trax::kOverhead) return;
  const std::uint8_t number = frame.bytes[2];
  if (phase_ == Phase::configuring) {
    if (attempts_ > 0 && commands_[current_].answer == number) go_on(now_ns);
    return;
  }
  if (number != number_of(trax::FrameNumber::data)) return;
  if (phase_ != Phase::awaiting_data && phase_ != Phase::running) return;
  phase_ = Phase::running;
  fruitless_ = 0;
  data_ns_ = now_ns;
  if (!polled_) due_ns_ = now_ns + stopped_after_ns_;
}

void StartUpPni::go_on(std::int64_t now_ns) {
  attempts_ = 0;
  due_ns_ = now_ns;
  if (++current_ < commands_.size()) return;
  phase_ = Phase::awaiting_data;
  data_ns_ = now_ns;
  if (!polled_) due_ns_ = now_ns + stopped_after_ns_;
}

std::optional<std::vector<std::uint8_t>> StartUpPni::next(std::int64_t now_ns) {
  if (phase_ == Phase::idle || now_ns < due_ns_) return std::nullopt;
  if (phase_ == Phase::configuring && attempts_ > 0) {
    const Command& command = commands_[current_];
    const bool asks_who = command.answer == number_of(trax::FrameNumber::module_info);
    if (command.answer == 0) {
      go_on(now_ns);
    } else if (attempts_ >= kPniAttempts && asks_who) {
      ++fruitless_;
      phase_ = Phase::resting;
      due_ns_ = now_ns + kPniRest_ns;
    } else if (attempts_ >= kPniAttempts) {
      if (!unanswered_.empty()) unanswered_ += ", ";
      unanswered_ += command.name;
      go_on(now_ns);
    }
  } else if (phase_ == Phase::resting) {
    begin(now_ns);
  } else if (phase_ == Phase::awaiting_data || phase_ == Phase::running) {
    if (now_ns - data_ns_ >= stopped_after_ns_) {
      if (phase_ == Phase::awaiting_data) ++fruitless_;
      // Continuous output that never began may be a mode that this device does not have.
      start(phase_ == Phase::awaiting_data && !polled_, now_ns);
    }
  }
  if (now_ns < due_ns_) return std::nullopt;
  if (phase_ == Phase::awaiting_data || phase_ == Phase::running) {
    due_ns_ = now_ns + std::llround(1e9 / rate_Hz_);
    return trax::encode_frame(trax::FrameNumber::get_data);
  }
  if (phase_ != Phase::configuring) return std::nullopt;
  ++attempts_;
  due_ns_ = now_ns + (commands_[current_].answer == 0 ? kPniObeys_ns : kPniAnswer_ns);
  return commands_[current_].bytes;
}

std::string StartUpPni::state() const {
  std::string text;
  switch (phase_) {
    case Phase::idle: return "not begun";
    case Phase::configuring: text = "configuring: " + std::string(commands_[current_].name); break;
    case Phase::awaiting_data: text = "configured, waiting for data"; break;
    case Phase::running: text = polled_ ? "running, polled" : "running"; break;
    case Phase::resting: text = "no answer: trying again every 10 s"; break;
  }
  if (phase_ != Phase::running && fruitless_ > 0) text += "; attempt " + std::to_string(fruitless_ + 1);
  if (!unanswered_.empty()) text += "; no answer to: " + unanswered_;
  return text;
}

std::unique_ptr<StartUp> start_pni(const config::PortSettings& settings) {
  return std::make_unique<StartUpPni>(settings);
}

}  // namespace navcal::instruments
