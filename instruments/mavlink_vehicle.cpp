// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "base/durations.h"
#include "instruments/autopilot_compass.h"
#include "instruments/devices.h"
#include "instruments/mavlink_decoder.h"
#include "protocols/mavlink.h"
#include "protocols/mavlink_signer.h"

namespace navcal::instruments {

namespace {

constexpr std::int64_t kAttitudeAge_ns = 100'000'000;

/// The sensors behind an autopilot at one port. The field gets the tilt of the newest attitude.
class MavlinkVehicle final : public Instrument {
 public:
  explicit MavlinkVehicle(const config::PortSettings& settings)
      : unit_(settings.inertial_unit - 1), barometer_(settings.pressure_sensor - 1) {
    if (settings.signing_key) signer_.emplace(*settings.signing_key);
  }

  Verdict read(const protocols::Frame& frame, Receiver& receiver) override {
    using Signature = protocols::mavlink::Signer::Verdict;
    switch (signer_ ? signer_->check(frame.bytes) : Signature::good) {
      case Signature::good: break;
      case Signature::not_signed: return Verdict::unsigned_;
      case Signature::wrong: return Verdict::forged;
      case Signature::replayed: return Verdict::replayed;
    }
    const auto message = protocols::mavlink::find_message(frame.bytes).message;
    const auto readings = decoder_.read(message);
    const std::uint8_t vehicle = decoder_.vehicle().value_or(message.system);
    auto verdict = message.system == vehicle ? Verdict::ignored : Verdict::foreign;
    for (MavlinkReading reading : readings) {
      if (!is_wanted(reading)) continue;
      if (auto* const compass = std::get_if<CompassSample>(&reading.value)) complete(*compass, reading);
      hand_over_reading(reading, message.component, receiver);
      verdict = Verdict::used;
    }
    return verdict;
  }
  [[nodiscard]] bool has_corrected_fields() const override { return decoder_.has_corrected_fields(unit_); }

 private:
  [[nodiscard]] bool is_wanted(const MavlinkReading& reading) const {
    if (std::holds_alternative<DepthSample>(reading.value)) return reading.instance == barometer_;
    if (std::holds_alternative<PowerSample>(reading.value)) return reading.instance == 0;
    const auto* const compass = std::get_if<CompassSample>(&reading.value);
    if (compass != nullptr && !compass->field_body_uT) return true;
    return reading.instance == unit_ || (compass == nullptr && !std::holds_alternative<ImuSample>(reading.value));
  }

  void complete(CompassSample& compass, const MavlinkReading& reading) {
    if (compass.heading_rad) {
      tilt_ = compass;
      tilt_ns_ = reading.device_time_ns;
    } else if (tilt_ns_ && reading.device_time_ns &&
               std::abs(*reading.device_time_ns - *tilt_ns_) <= kAttitudeAge_ns) {
      compass.pitch_rad = tilt_.pitch_rad;
      compass.roll_rad = tilt_.roll_rad;
    }
  }

  static void hand_over_reading(const MavlinkReading& reading, std::uint8_t component, Receiver& receiver) {
    const std::uint8_t clock = component == protocols::mavlink::kAutopilot ? 0 : component;
    receiver.on_measurement(
        {.value = reading.value, .device_time_ns = reading.device_time_ns, .paces = false, .clock = clock});
  }

  int unit_, barometer_;  ///< instances
  MavlinkDecoder decoder_;
  CompassSample tilt_;
  std::optional<std::int64_t> tilt_ns_;
  std::optional<protocols::mavlink::Signer> signer_;
};

namespace mavlink = protocols::mavlink;

constexpr std::uint32_t kHeartbeat = 0, kAck = 77, kCommand = 76, kHighresImu = 105, kParameter = 22,
                        kTimesync = 111;
constexpr std::uint16_t kSetMessageInterval = 511;
constexpr std::uint8_t kOurComponent = 197, kOnboardController = 18;
constexpr int kHeartbeatsOfRound = 30;  // heartbeats; then a ground station may have asked for other rates
constexpr std::int64_t kAutopilotLost_ns = 5 * base::kSecond_ns;

/// MAVLink (ICD section 17): a heartbeat once a second, in the name of a component of the vehicle, so that routers
/// forward what is for us; the rates of the messages and the calibration of the compass, again every half minute
/// and when the autopilot has restarted.
class StartUpMavlink final : public StartUp {
 public:
  explicit StartUpMavlink(const config::PortSettings& settings) : unit_(settings.inertial_unit - 1) {
    constexpr std::array<std::uint32_t, 3> kImu{27, 116, 129}, kPressure{29, 137, 143};
    constexpr std::uint32_t kOutputs = 36, kAttitude = 30, kBattery = 147, kGps = 24;
    const double rate_Hz = settings.rate_Hz > 0 ? settings.rate_Hz : 50;
    if (settings.signing_key) signer_.emplace(*settings.signing_key);
    names_ = AutopilotCompass::names(unit_);
    imu_ = kImu.at(static_cast<std::size_t>(unit_));
    if (settings.inertial_unit == 1) requests_.push_back({kHighresImu, rate_Hz});
    requests_.insert(requests_.end(),
                     {{imu_, rate_Hz}, {kOutputs, rate_Hz}, {kAttitude, 20}, {kBattery, 10}, {kGps, 5}});
    if (settings.pressure_sensor <= 3)
      requests_.push_back({kPressure.at(static_cast<std::size_t>(settings.pressure_sensor - 1)), 10});
  }

 private:
  using Request = std::pair<std::uint32_t, double>;  // message, Hz

  Script script() override {
    for (;;) {
      vehicle_.reset();
      round_trip_ns_.reset();
      enter("waiting for the heartbeat of an autopilot");
      while (!vehicle_)
        co_await wait(base::kSecond_ns, [this](const protocols::Frame&) { return vehicle_.has_value(); });
      while (now_ns() - heard_ns_ < kAutopilotLost_ns) {
        restarted_ = false;
        std::string refused, unanswered;
        bool has_high_resolution = false, is_answering = false;
        if (!in_service()) enter(fmt::format("asking system {} for its messages", *vehicle_));
        co_await send(heartbeat(), 0);
        for (const std::string& name : names_) {
          parameter_.clear();
          const bool is_known = co_await ask(reading(name), 3, base::kSecond_ns / 2,
                                             [&](const protocols::Frame&) { return parameter_ == name; });
          if (!is_known && name == names_.front()) break;  // not ArduPilot
          is_answering = true;
        }
        for (const Request& request : requests_) {
          if (request.first == imu_ && has_high_resolution) continue;
          co_await send(heartbeat(), 0);
          if (is_time_due()) co_await send(time_request(), 0);
          result_ = kNoAnswer;
          const bool is_answered = co_await ask(interval(request), is_answering ? 3 : 1, base::kSecond_ns / 2,
                                                [this](const protocols::Frame&) { return result_ != kNoAnswer; });
          const bool is_accepted = is_answered && result_ == 0;
          is_answering |= is_answered;
          if (request.first == kHighresImu)
            has_high_resolution = is_accepted;
          else if (!is_accepted)
            note(is_answered ? refused : unanswered, std::string(mavlink::message_of(request.first)->name));
        }
        // Whole: each change of the words is an event.
        refused_ = refused;
        unanswered_ = is_answering ? unanswered : "";
        enter(fmt::format(
                  "running, system {}{}{}; the compass's own calibration {}", *vehicle_,
                  is_answering ? "" : "; nothing answers, navcal goes on by what comes", delay_words(),
                  compass_.measured_uT(unit_, {}, 0.0) ? "is undone" : "is not known, and stays in the field"),
              true);
        for (int i = 0; i < kHeartbeatsOfRound && !restarted_ && now_ns() - heard_ns_ < kAutopilotLost_ns; ++i) {
          if (is_time_due()) co_await send(time_request(), 0);
          co_await send(heartbeat(), base::kSecond_ns);
        }
      }
    }
  }

  void sign(std::vector<std::uint8_t>& command) override {
    if (signer_) signer_->sign(command);
  }
  void on_any_frame(const protocols::Frame& frame) override {
    if (signer_ && signer_->check(frame.bytes) != mavlink::Signer::Verdict::good) return;
    const mavlink::Message message = mavlink::find_message(frame.bytes).message;
    const mavlink::Payload payload(message.payload);
    if (message.component != mavlink::kAutopilot || (vehicle_ && *vehicle_ != message.system)) return;
    if (message.id == kHeartbeat && payload.at<std::uint8_t>(5) != mavlink::kNoAutopilot) {
      vehicle_ = message.system;
      heard_ns_ = now_ns();
    }
    if (message.id == kAck && payload.at<std::uint16_t>(0) == kSetMessageInterval &&
        (payload.at<std::uint8_t>(9) == 0 || payload.at<std::uint8_t>(9) == kOurComponent))
      result_ = payload.at<std::uint8_t>(2);
    if (message.id == kParameter) {
      parameter_ = payload.text(8, 16);
      compass_.take(parameter_, payload.at<float>(0));
    }
    if (message.id == kTimesync && asked_ns_ && payload.at<std::int64_t>(0) != 0 &&
        payload.at<std::int64_t>(8) == *asked_ns_) {
      round_trip_ns_ = std::min(now_ns() - *asked_ns_, round_trip_ns_.value_or(INT64_MAX));
      asked_ns_.reset();
    }
    if (message.id != 30) return;
    const auto boot_ms = payload.at<std::uint32_t>(0);
    if (boot_ms < boot_ms_ && boot_ms_ - boot_ms > 1000) restarted_ = true;
    boot_ms_ = boot_ms;
  }

  /// One question at a time, or a late answer would be taken for none.
  [[nodiscard]] bool is_time_due() const { return !asked_ns_ || now_ns() - *asked_ns_ >= base::kSecond_ns; }
  /// TIMESYNC. Half of the way there and back is no time of the vehicle: one way may be slower than the other. The
  /// whole is a bound of the delay that is always there, which no stamp shows.
  std::vector<std::uint8_t> time_request() {
    asked_ns_ = now_ns();
    return mavlink::encode(kTimesync, sender(),
                           protocols::packed_le(std::int64_t{0}, *asked_ns_, *vehicle_, mavlink::kAutopilot));
  }
  /// In steps: each change of the words is an event.
  [[nodiscard]] std::string delay_words() const {
    if (!round_trip_ns_) return "";
    for (const int bound_ms : {1, 2, 5, 10, 20, 50, 100, 200, 500})
      if (*round_trip_ns_ <= bound_ms * base::kMillisecond_ns)
        return fmt::format("; times late by at most {} ms on the link", bound_ms);
    return "; times may be late by half a second or more on the link";
  }
  std::vector<std::uint8_t> heartbeat() { return mavlink::encode_heartbeat(sender(), kOnboardController); }
  std::vector<std::uint8_t> interval(const Request& request) {
    std::array<std::uint8_t, 33> payload{};
    protocols::put_le(payload.data(), static_cast<float>(request.first));
    protocols::put_le(payload.data() + 4, static_cast<float>(std::round(1e6 / request.second)));
    protocols::put_le(payload.data() + 28, kSetMessageInterval);
    payload[30] = *vehicle_;
    payload[31] = mavlink::kAutopilot;
    return mavlink::encode(kCommand, sender(), payload);
  }

  std::vector<std::uint8_t> reading(const std::string& parameter) {
    return mavlink::encode_reading(sender(), *vehicle_, parameter);
  }

  mavlink::Sender sender() { return {*vehicle_, kOurComponent, sequence_++}; }

  static constexpr int kNoAnswer = -1;
  std::vector<Request> requests_;
  int unit_;                        ///< instance of the inertial unit and its compass
  std::vector<std::string> names_;  ///< parameters of the compass
  AutopilotCompass compass_;
  std::string parameter_;  ///< name of the newest that came
  std::uint32_t imu_ = 0;  ///< the message of the inertial unit, without HIGHRES_IMU
  std::optional<std::uint8_t> vehicle_;
  std::int64_t heard_ns_ = 0;
  std::optional<std::int64_t> asked_ns_;       ///< when the clock of the autopilot was asked for
  std::optional<std::int64_t> round_trip_ns_;  ///< the least until its answer
  std::uint32_t boot_ms_ = 0;
  std::uint8_t sequence_ = 0;
  int result_ = kNoAnswer;  ///< of the newest request
  bool restarted_ = false;
  std::optional<mavlink::Signer> signer_;
};

}  // namespace

std::unique_ptr<Instrument> make_mavlink(const config::PortSettings& settings) {
  return std::make_unique<MavlinkVehicle>(settings);
}

std::unique_ptr<StartUp> start_mavlink(const config::PortSettings& settings) {
  return std::make_unique<StartUpMavlink>(settings);
}

}  // namespace navcal::instruments
