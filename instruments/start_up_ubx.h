// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "instruments/start_up.h"
#include "protocols/ubx_configuration.h"

namespace navcal::instruments {

/// u-blox receiver (ICD section 6): asks for its version, then sets rate, messages and protocols in its RAM with
/// CFG-VALSET. The receiver does not tell at which of its ports we are: they are tried one after the other until
/// NAV-PVT comes. A receiver that refuses CFG-VALSET is set with CFG-MSG and CFG-RATE, which concern the port that
/// carries them. Begins again when NAV-PVT stops, as after a restart of the receiver.
class StartUpUbx final : public StartUp {
 public:
  explicit StartUpUbx(const config::PortSettings& settings);

  void begin(std::int64_t now_ns) override;
  void on_frame(const protocols::Frame& frame, std::int64_t now_ns) override;
  std::optional<std::vector<std::uint8_t>> next(std::int64_t now_ns) override;
  [[nodiscard]] bool in_service() const override { return phase_ == Phase::running; }
  [[nodiscard]] std::string state() const override;

 private:
  using MessageCode = protocols::ubx::MessageCode;
  using ReceiverPort = protocols::ubx::ReceiverPort;

  enum class Phase : std::uint8_t {
    idle,      ///< begin() has not been called
    version,   ///< MON-VER is to be asked for
    setting,   ///< CFG-VALSET for ports_[port_] is to be sent or waits for its answer
    legacy,    ///< legacy_[step_] is to be sent or waits for its answer
    awaiting,  ///< all is sent, NAV-PVT is waited for
    resting,   ///< it did not come; all is repeated at due_ns_
    running,
  };
  /// A message of class CFG that is answered by ACK-ACK or ACK-NAK.
  struct Step {
    MessageCode code = 0;
    std::string what;  ///< for people
    std::vector<std::uint8_t> bytes;
    bool needed = false;  ///< without it the rest is of no use
  };

  void start_over(std::int64_t now_ns);
  void enter(Phase phase, std::int64_t now_ns);
  void on_answer(bool accepted, std::int64_t now_ns);
  void go_on(std::int64_t now_ns);
  void next_port(std::int64_t now_ns);
  /// Nothing helped: all is repeated after a while.
  void rest(std::int64_t now_ns);
  [[nodiscard]] const Step* current() const;
  std::optional<std::vector<std::uint8_t>> send(std::int64_t now_ns);

  std::vector<Step> values_;  ///< one for each port of the receiver, the likely one first
  std::vector<Step> legacy_;
  std::int64_t stopped_after_ns_;  ///< NAV-PVT is taken to have stopped after this time without one
  Phase phase_ = Phase::idle;
  std::size_t step_ = 0;
  int attempts_ = 0;                            ///< times that the current step was sent
  bool by_values_ = false;                      ///< a CFG-VALSET was accepted in this dialogue
  bool nmea_seen_ = false;                      ///< in this dialogue
  unsigned fruitless_ = 0;                      ///< dialogues in a row after which no NAV-PVT came
  std::string version_, refused_, unanswered_;  ///< for people
};

}  // namespace navcal::instruments
