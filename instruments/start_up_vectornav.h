// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "instruments/start_up.h"
#include "protocols/vectornav_lines.h"

namespace navcal::instruments {

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

}  // namespace navcal::instruments
