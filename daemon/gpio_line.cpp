// SPDX-License-Identifier: Apache-2.0
// The kernel's GPIO lines, through libgpiod.
#include <fmt/format.h>
#include <gpiod.h>

#include <cerrno>
#include <cstring>

#include "daemon/power_line.h"

namespace navcal::daemon {
namespace {

struct CloseChip {
  void operator()(gpiod_chip* chip) const { gpiod_chip_close(chip); }
};

class GpioLine final : public PowerLine {
 public:
  GpioLine(std::unique_ptr<gpiod_chip, CloseChip> chip, gpiod_line* line) : chip_(std::move(chip)), line_(line) {}

  [[nodiscard]] std::optional<bool> is_on() const override {
    if (gpiod_line_direction(line_) != GPIOD_LINE_DIRECTION_OUTPUT) return std::nullopt;
    const int value = gpiod_line_get_value(line_);
    return value < 0 ? std::nullopt : std::optional(value != 0);
  }
  [[nodiscard]] std::string set(bool on) override {
    const int value = on ? 1 : 0;
    const bool is_output = gpiod_line_direction(line_) == GPIOD_LINE_DIRECTION_OUTPUT;
    const int failed =
        is_output ? gpiod_line_set_value(line_, value) : gpiod_line_set_direction_output(line_, value);
    return failed == 0 ? std::string() : std::string(std::strerror(errno));
  }

 private:
  std::unique_ptr<gpiod_chip, CloseChip> chip_;  ///< closing it releases the line
  gpiod_line* line_;
};

}  // namespace

std::unique_ptr<PowerLine> open_gpio_line(const config::PowerSettings& settings, std::string& problem) {
  const auto fail = [&](std::string_view what) {
    problem = fmt::format("{} line {}: {}: {}", settings.gpio_chip, settings.line, what, std::strerror(errno));
    return nullptr;
  };
  std::unique_ptr<gpiod_chip, CloseChip> chip(gpiod_chip_open_lookup(settings.gpio_chip.c_str()));
  if (!chip) return fail("the controller cannot be opened");
  gpiod_line* const line = gpiod_chip_get_line(chip.get(), static_cast<unsigned>(settings.line));
  if (line == nullptr) return fail("there is no such line");
  const bool leave = settings.at_start == config::PowerAtStart::leave;
  gpiod_line_request_config request{};
  request.consumer = "navcald";
  request.request_type = leave ? GPIOD_LINE_REQUEST_DIRECTION_AS_IS : GPIOD_LINE_REQUEST_DIRECTION_OUTPUT;
  request.flags = settings.active_low ? GPIOD_LINE_REQUEST_FLAG_ACTIVE_LOW : 0;
  if (gpiod_line_request(line, &request, settings.at_start == config::PowerAtStart::on ? 1 : 0) != 0)
    return fail("it cannot be taken");
  return std::make_unique<GpioLine>(std::move(chip), line);
}

}  // namespace navcal::daemon
