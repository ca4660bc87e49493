// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "instruments/start_up.h"

namespace navcal::instruments {

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

}  // namespace navcal::instruments
