// SPDX-License-Identifier: Apache-2.0
// The kernel's GPIO lines, through libgpiod, whose version 2 has another interface than version 1.
#include <fmt/format.h>
#include <gpiod.h>

#include <cerrno>
#include <cstring>

#include "daemon/power_control.h"

namespace navcal::daemon {
namespace {

template <auto kFree>
struct Free {
  template <typename T>
  void operator()(T* held) const {
    kFree(held);
  }
};
using Chip = std::unique_ptr<gpiod_chip, Free<gpiod_chip_close>>;

#ifdef NAVCAL_LIBGPIOD_1  // Debian 12

class GpioLine final : public PowerLine {
 public:
  GpioLine(Chip chip, gpiod_line* line) : chip_(std::move(chip)), line_(line) {}

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
  Chip chip_;  ///< closing it releases the line
  gpiod_line* line_;
};

#else

using LineInfo = std::unique_ptr<gpiod_line_info, Free<gpiod_line_info_free>>;
using LineSettings = std::unique_ptr<gpiod_line_settings, Free<gpiod_line_settings_free>>;
using LineConfig = std::unique_ptr<gpiod_line_config, Free<gpiod_line_config_free>>;
using RequestConfig = std::unique_ptr<gpiod_request_config, Free<gpiod_request_config_free>>;
using LineRequest = std::unique_ptr<gpiod_line_request, Free<gpiod_line_request_release>>;

/// None when there is no memory for it.
LineConfig config_of(unsigned line, gpiod_line_direction direction, bool active_low, bool on) {
  const LineSettings settings(gpiod_line_settings_new());
  LineConfig config(gpiod_line_config_new());
  if (!settings || !config) return nullptr;
  gpiod_line_settings_set_direction(settings.get(), direction);
  gpiod_line_settings_set_active_low(settings.get(), active_low);
  gpiod_line_settings_set_output_value(settings.get(), on ? GPIOD_LINE_VALUE_ACTIVE : GPIOD_LINE_VALUE_INACTIVE);
  if (gpiod_line_config_add_line_settings(config.get(), &line, 1, settings.get()) != 0) return nullptr;
  return config;
}

class GpioLine final : public PowerLine {
 public:
  GpioLine(Chip chip, LineRequest request, unsigned line, bool active_low)
      : chip_(std::move(chip)), request_(std::move(request)), line_(line), active_low_(active_low) {}

  [[nodiscard]] std::optional<bool> is_on() const override {
    const LineInfo info(gpiod_chip_get_line_info(chip_.get(), line_));
    if (!info || gpiod_line_info_get_direction(info.get()) != GPIOD_LINE_DIRECTION_OUTPUT) return std::nullopt;
    const gpiod_line_value value = gpiod_line_request_get_value(request_.get(), line_);
    return value == GPIOD_LINE_VALUE_ERROR ? std::nullopt : std::optional(value == GPIOD_LINE_VALUE_ACTIVE);
  }
  [[nodiscard]] std::string set(bool on) override {
    const LineConfig config = config_of(line_, GPIOD_LINE_DIRECTION_OUTPUT, active_low_, on);
    if (config && gpiod_line_request_reconfigure_lines(request_.get(), config.get()) == 0) return {};
    return std::strerror(errno);
  }

 private:
  Chip chip_;
  LineRequest request_;
  unsigned line_;
  bool active_low_;
};

#endif

}  // namespace

std::unique_ptr<PowerLine> open_gpio_line(const config::PowerSettings& settings, std::string& problem) {
  const auto fail = [&](std::string_view what) {
    problem = fmt::format("{} line {}: {}: {}", settings.gpio_chip, settings.line, what, std::strerror(errno));
    return nullptr;
  };
  const bool named = !settings.gpio_chip.starts_with('/');
  Chip chip(gpiod_chip_open(((named ? "/dev/" : "") + settings.gpio_chip).c_str()));
  if (!chip) return fail("the controller cannot be opened");
  const auto offset = static_cast<unsigned>(settings.line);
  const bool leave = settings.at_start == config::PowerAtStart::leave,
             on = settings.at_start == config::PowerAtStart::on;
#ifdef NAVCAL_LIBGPIOD_1
  gpiod_line* const line = gpiod_chip_get_line(chip.get(), offset);
  if (line == nullptr) return fail("there is no such line");
  gpiod_line_request_config request{};
  request.consumer = "navcald";
  request.request_type = leave ? GPIOD_LINE_REQUEST_DIRECTION_AS_IS : GPIOD_LINE_REQUEST_DIRECTION_OUTPUT;
  request.flags = settings.active_low ? GPIOD_LINE_REQUEST_FLAG_ACTIVE_LOW : 0;
  if (gpiod_line_request(line, &request, on ? 1 : 0) != 0) return fail("it cannot be taken");
  return std::make_unique<GpioLine>(std::move(chip), line);
#else
  if (!LineInfo(gpiod_chip_get_line_info(chip.get(), offset))) return fail("there is no such line");
  const LineConfig config =
      config_of(offset, leave ? GPIOD_LINE_DIRECTION_AS_IS : GPIOD_LINE_DIRECTION_OUTPUT, settings.active_low, on);
  const RequestConfig consumer(gpiod_request_config_new());
  if (!config || !consumer) return fail("it cannot be taken");
  gpiod_request_config_set_consumer(consumer.get(), "navcald");
  LineRequest request(gpiod_chip_request_lines(chip.get(), consumer.get(), config.get()));
  if (!request) return fail("it cannot be taken");
  return std::make_unique<GpioLine>(std::move(chip), std::move(request), offset, settings.active_low);
#endif
}

}  // namespace navcal::daemon
