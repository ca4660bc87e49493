// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "instruments/dialogue.h"

namespace navcal::instruments {

/// The dialogue that brings a device to the configured state (ICD sections 1 and 2), and again after the device
/// has lost its power. Its script has no end.
class StartUp : public Dialogue {
 public:
  /// To be called when the port was opened, or opened anew.
  void begin(std::int64_t now_ns) {
    fruitless_ = 0;
    start_at(now_ns);
  }
  /// True when the dialogue is over and the device delivers.
  [[nodiscard]] bool in_service() const { return in_service_; }
  /// State as text for people: "running", "settings sent", "no answer to Ha: trying Ea", ...
  [[nodiscard]] std::string state() const {
    std::string text = text_ + remark();
    if (!refused_.empty()) text += "; refused: " + refused_;
    if (!unanswered_.empty()) text += "; no answer to: " + unanswered_;
    return text;
  }

 protected:
  explicit StartUp(std::string before = "not begun") : text_(std::move(before)) {}
  /// Words that state() adds to those of enter().
  [[nodiscard]] virtual std::string remark() const { return {}; }

  void enter(std::string phase, bool in_service = false) {
    text_ = std::move(phase);
    in_service_ = in_service;
  }
  /// "; attempt 3" after two rounds in which nothing came.
  [[nodiscard]] std::string attempt() const {
    return in_service_ || fruitless_ == 0 ? "" : "; attempt " + std::to_string(fruitless_ + 1);
  }
  static void note(std::string& list, const std::string& what) { list += (list.empty() ? "" : ", ") + what; }

  unsigned fruitless_ = 0;            ///< rounds in a row after which nothing came
  std::string refused_, unanswered_;  ///< commands of this round, for people

 private:
  bool in_service_ = false;
  std::string text_;
};

/// nullptr for a device that takes no commands (IMU card, motor card, NMEA) or when start_up is off.
[[nodiscard]] std::unique_ptr<StartUp> make_start_up(const config::PortSettings& settings);

}  // namespace navcal::instruments
