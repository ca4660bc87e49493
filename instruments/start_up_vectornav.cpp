// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "base/durations.h"
#include "instruments/start_ups.h"
#include "protocols/vectornav_lines.h"

namespace navcal::instruments {
namespace {

namespace vn = protocols::vectornav;

constexpr std::int64_t kVnAnswer_ns = 300 * base::kMillisecond_ns;
constexpr std::int64_t kVnStopped_ns = base::kSecond_ns;
constexpr std::int64_t kVnRest_ns = 10 * base::kSecond_ns;
constexpr int kVnAttempts = 3;
constexpr double kImuRate_Hz = 800;  // of which binary outputs are a whole part
constexpr double kVnUsualRate_Hz = 40;
constexpr std::uint8_t kInvalidChecksum = 3;

/// The common group with time since start-up, yaw, pitch and roll, rate, acceleration, and field with temperature
/// and pressure; and from the attitude group the standard deviations of yaw, pitch and roll.
constexpr std::string_view kWithErrors = "11,0529,0100";
/// Without the latter, which old firmware does not have.
constexpr std::string_view kWithoutErrors = "01,0529";

/// The nearest of the rates that register 7 takes.
int line_rate(double rate_Hz) {
  constexpr std::array<int, 11> kRates{1, 2, 4, 5, 10, 20, 25, 40, 50, 100, 200};
  return *std::min_element(kRates.begin(), kRates.end(),
                           [rate_Hz](int a, int b) { return std::abs(a - rate_Hz) < std::abs(b - rate_Hz); });
}

std::string words_of(const vn::Register& content) {
  const auto line = vn::encode_register(content);
  return {line.begin() + 1, std::find(line.begin(), line.end(), std::uint8_t{'*'})};
}

bool is_question_answered(const std::optional<vn::Register>& answer, unsigned number) {
  return answer && !answer->write && answer->number == number;
}

/// VectorNav (ICD section 12): turns the lines off (register 6) and binary output 1 on (register 75) at the first
/// serial port of the sensor, then at the second. A sensor that sends no binary messages is set to lines VNYMR
/// (registers 7 and 6). Registers are written in the sensor's memory only, which a loss of power clears. Begins
/// again when the messages stop.
class StartUpVectorNav final : public StartUp {
 public:
  explicit StartUpVectorNav(const config::PortSettings& settings);

  void begin(std::int64_t now_ns) override;
  void on_frame(const protocols::Frame& frame, std::int64_t now_ns) override;
  std::optional<std::vector<std::uint8_t>> next(std::int64_t now_ns) override;
  [[nodiscard]] bool in_service() const override { return phase_ == Phase::running; }
  [[nodiscard]] std::string state() const override;

 private:
  enum class Phase : std::uint8_t {
    idle,      ///< begin() has not been called
    model,     ///< the questions for model and firmware are to be sent
    setting,   ///< steps_[step_] is to be sent or waits for its answer
    awaiting,  ///< measurements are waited for
    resting,   ///< none came; all is repeated at due_ns_
    running,
  };
  enum class Purpose : std::uint8_t { silence, binary, lines };
  struct Step {
    Purpose purpose{};
    protocols::vectornav::Register content;
    bool measures = false;  ///< when it is accepted, measurements must come
  };

  void start_over(std::int64_t now_ns);
  void on_measurement(bool binary, std::int64_t now_ns);
  void on_answer(const protocols::Frame& frame, std::int64_t now_ns);
  void go_on(std::int64_t now_ns);
  void await(std::int64_t now_ns);
  void note(std::string& list, const std::string& reason = {});
  std::optional<std::vector<std::uint8_t>> send(std::int64_t now_ns);

  std::vector<Step> steps_;
  std::int64_t stopped_after_ns_;  ///< measurements are taken to have stopped after this time without one
  Phase phase_ = Phase::idle;
  std::size_t step_ = 0;
  int attempts_ = 0;                                     ///< times that the current step was sent
  unsigned questions_ = 0;                               ///< that were sent
  bool deaf_ = false;                                    ///< the sensor answered nothing: whatever comes is taken
  bool binary_ = false;                                  ///< what it runs on
  unsigned fruitless_ = 0;                               ///< dialogues in a row after which no measurement came
  std::string model_, firmware_, refused_, unanswered_;  ///< for people
};

}  // namespace

StartUpVectorNav::StartUpVectorNav(const config::PortSettings& settings) : stopped_after_ns_(kVnStopped_ns) {
  const double rate_Hz = settings.rate_Hz > 0 ? settings.rate_Hz : kVnUsualRate_Hz;
  stopped_after_ns_ = std::max(kVnStopped_ns, static_cast<std::int64_t>(3e9 / rate_Hz));
  const auto divisor = static_cast<int>(std::clamp(std::round(kImuRate_Hz / rate_Hz), 1.0, 65535.0));
  steps_.push_back({Purpose::silence, {true, vn::kAsyncType, "0"}, false});
  for (const std::string_view fields : {kWithErrors, kWithoutErrors}) {
    for (const char* port : {"1", "2"}) {
      steps_.push_back({Purpose::binary,
                        {true, vn::kBinaryOutput1,
                         port + std::string(",") + std::to_string(divisor) + ',' + std::string(fields)},
                        true});
    }
  }
  steps_.push_back({Purpose::lines, {true, vn::kAsyncRate, std::to_string(line_rate(rate_Hz))}, false});
  steps_.push_back({Purpose::lines, {true, vn::kAsyncType, "14"}, true});  // VNYMR
}

void StartUpVectorNav::begin(std::int64_t now_ns) {
  fruitless_ = 0;
  model_.clear();
  firmware_.clear();
  start_over(now_ns);
}

void StartUpVectorNav::start_over(std::int64_t now_ns) {
  phase_ = Phase::model;
  step_ = 0;
  attempts_ = 0;
  questions_ = 0;
  deaf_ = false;
  refused_.clear();
  unanswered_.clear();
  due_ns_ = now_ns;
}

void StartUpVectorNav::on_frame(const protocols::Frame& frame, std::int64_t now_ns) {
  if (phase_ == Phase::idle) return;
  if (frame.id == vn::kBinary) return on_measurement(true, now_ns);
  const std::string_view id = frame.id.view();
  if (id == "VNRRG" || id == "VNWRG" || id == "VNERR") return on_answer(frame, now_ns);
  if (vn::decode_line(frame.bytes)) on_measurement(false, now_ns);
}

void StartUpVectorNav::on_measurement(bool binary, std::int64_t now_ns) {
  if (phase_ == Phase::awaiting) {
    const bool wanted = deaf_ || binary == (steps_[step_].purpose == Purpose::binary);
    if (!wanted) return;
    phase_ = Phase::running;
    binary_ = binary;
    fruitless_ = 0;
  }
  if (phase_ == Phase::running && binary == binary_) due_ns_ = now_ns + stopped_after_ns_;
}

void StartUpVectorNav::on_answer(const protocols::Frame& frame, std::int64_t now_ns) {
  const auto answer = vn::decode_register(frame.bytes);
  if (is_question_answered(answer, vn::kModel)) model_ = answer->values;
  if (is_question_answered(answer, vn::kFirmware)) firmware_ = answer->values;
  if (phase_ != Phase::setting || attempts_ == 0) return;
  const Step& step = steps_[step_];
  if (const auto error = vn::decode_error(frame.bytes)) {
    // A command that was damaged on the way is repeated when its answer is due.
    if (*error == kInvalidChecksum) return;
    note(refused_, std::string(vn::meaning_of(*error)));
    go_on(now_ns);
  } else if (answer && answer->write && answer->number == step.content.number) {
    if (step.measures) {
      await(now_ns);
    } else {
      go_on(now_ns);
    }
  }
}

void StartUpVectorNav::await(std::int64_t now_ns) {
  phase_ = Phase::awaiting;
  due_ns_ = now_ns + stopped_after_ns_;
}

void StartUpVectorNav::go_on(std::int64_t now_ns) {
  if (step_ + 1 == steps_.size()) return await(now_ns);
  phase_ = Phase::setting;
  ++step_;
  attempts_ = 0;
  due_ns_ = now_ns;
}

void StartUpVectorNav::note(std::string& list, const std::string& reason) {
  if (!list.empty()) list += ", ";
  list += words_of(steps_[step_].content);
  if (!reason.empty()) list += " (" + reason + ')';
}

std::optional<std::vector<std::uint8_t>> StartUpVectorNav::next(std::int64_t now_ns) {
  if (now_ns < due_ns_) return std::nullopt;
  switch (phase_) {
    case Phase::idle: return std::nullopt;
    case Phase::model:
      if (questions_ == 2) {
        phase_ = Phase::setting;
        return send(now_ns);
      }
      return vn::encode_register({false, questions_++ == 0 ? vn::kModel : vn::kFirmware, {}});
    case Phase::setting: return send(now_ns);
    case Phase::awaiting:
      if (!deaf_ && step_ + 1 < steps_.size()) {
        go_on(now_ns);
        return send(now_ns);
      }
      ++fruitless_;
      phase_ = Phase::resting;
      due_ns_ = now_ns + kVnRest_ns;
      return std::nullopt;
    case Phase::resting:
    case Phase::running: start_over(now_ns); return next(now_ns);
  }
  return std::nullopt;
}

std::optional<std::vector<std::uint8_t>> StartUpVectorNav::send(std::int64_t now_ns) {
  if (attempts_ == kVnAttempts) {
    note(unanswered_);
    if (step_ == 0) {
      deaf_ = true;
      await(now_ns);
      return std::nullopt;
    }
    go_on(now_ns);
    if (phase_ != Phase::setting) return std::nullopt;
  }
  ++attempts_;
  due_ns_ = now_ns + kVnAnswer_ns;
  return vn::encode_register(steps_[step_].content);
}

std::string StartUpVectorNav::state() const {
  std::string text;
  switch (phase_) {
    case Phase::idle: return "not begun";
    case Phase::model: text = "asking for the model"; break;
    case Phase::setting: text = "setting " + words_of(steps_[step_].content); break;
    case Phase::awaiting:
      text = deaf_ ? "no answers, waiting for measurements" : "settings sent, waiting for measurements";
      break;
    case Phase::resting:
      text = "no measurements come; trying again every 10 s, " + std::to_string(fruitless_) + " so far";
      break;
    case Phase::running: text = binary_ ? "running on binary messages" : "running on lines"; break;
  }
  if (!model_.empty()) text += "; " + model_;
  if (!firmware_.empty()) text += ", firmware " + firmware_;
  if (!refused_.empty()) text += "; refused: " + refused_;
  if (!unanswered_.empty()) text += "; no answer to: " + unanswered_;
  return text;
}

std::unique_ptr<StartUp> start_vectornav(const config::PortSettings& settings) {
  return std::make_unique<StartUpVectorNav>(settings);
}

}  // namespace navcal::instruments
