// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "base/durations.h"
#include "instruments/devices.h"
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

bool is_number(const protocols::Frame& frame, std::uint8_t number) {
  return frame.bytes.size() >= trax::kOverhead && frame.bytes[2] == number;
}

/// PNI TRAX, TCM3 and Prime (ICD section 11): stops the output, asks who is there, sets magnetic north, degrees
/// and byte order, the interval and the components, and starts continuous output. A device that sends nothing then
/// is polled. Nothing is saved in the device. Begins anew when the data stop.
class StartUpPni final : public StartUp {
 public:
  explicit StartUpPni(const config::PortSettings& settings)
      : rate_Hz_(settings.rate_Hz > 0 ? settings.rate_Hz : kUsualPniRate_Hz) {}

 private:
  struct Command {
    std::vector<std::uint8_t> bytes;
    std::uint8_t answer = 0;  ///< number of the frame that answers it; 0: none does
    std::string_view name{};
  };

  /// The first command also ends a frame that was cut off: the device has no other sign of where one begins.
  [[nodiscard]] std::vector<Command> commands(bool polled) const {
    using trax::FrameNumber;
    using trax::Setting;
    constexpr auto kDone = number_of(FrameNumber::set_config_done);
    std::vector<Command> commands{
        {trax::encode_frame(FrameNumber::stop_continuous), 0, "stop"},
        {trax::encode_frame(FrameNumber::get_module_info), number_of(FrameNumber::module_info), "GetModInfo"},
        {trax::encode_setting(Setting::true_north, 0), kDone, "magnetic north"},
        {trax::encode_setting(Setting::mils, 0), kDone, "degrees"},
        {trax::encode_setting(Setting::big_endian, 1), kDone, "byte order"},
        {trax::encode_acquisition({polled, polled ? 0 : 1 / rate_Hz_}), number_of(FrameNumber::acquisition_done),
         "acquisition"},
        {trax::encode_components(kComponents), 0, "components"}};
    if (!polled) commands.push_back({trax::encode_frame(FrameNumber::start_continuous), 0, "start"});
    return commands;
  }

  Script script() override {
    const std::int64_t stopped_ns = stopped_after_ns(rate_Hz_, kPniStopped_ns);
    for (bool polled = false;;) {
      unanswered_.clear();
      bool is_there = true;
      for (const Command& command : commands(polled)) {
        enter("configuring: " + std::string(command.name));
        if (command.answer == 0) {
          co_await send(command.bytes, kPniObeys_ns);
          continue;
        }
        const bool answered =
            co_await ask(command.bytes, kPniAttempts, kPniAnswer_ns,
                         [&command](const protocols::Frame& frame) { return is_number(frame, command.answer); });
        is_there = answered || command.answer != number_of(trax::FrameNumber::module_info);
        if (!is_there) break;
        if (!answered) note(unanswered_, std::string(command.name));
      }
      if (!is_there) {
        ++fruitless_;
        enter("no answer: trying again every 10 s");
        co_await wait(kPniRest_ns);
        polled = false;
        continue;
      }
      enter("configured, waiting for data");
      std::int64_t data_ns = now_ns();  // the newest came, or was first waited for
      const auto is_data = [this, polled, &data_ns](const protocols::Frame& frame) {
        if (!is_number(frame, number_of(trax::FrameNumber::data))) return false;
        if (!in_service()) enter(polled ? "running, polled" : "running", true);
        fruitless_ = 0;
        data_ns = now_ns();
        return !polled;  // polls keep their beat
      };
      while (now_ns() - data_ns < stopped_ns) {
        if (polled) {
          co_await ask(trax::encode_frame(trax::FrameNumber::get_data), 1, std::llround(1e9 / rate_Hz_), is_data);
        } else {
          co_await wait(stopped_ns, is_data);
        }
      }
      if (!in_service()) ++fruitless_;
      // Continuous output that never began may be a mode that this device does not have.
      polled = !in_service() && !polled;
    }
  }
  [[nodiscard]] std::string remark() const override { return attempt(); }

  double rate_Hz_;
};

}  // namespace

std::unique_ptr<StartUp> start_pni(const config::PortSettings& settings) {
  return std::make_unique<StartUpPni>(settings);
}

}  // namespace navcal::instruments
