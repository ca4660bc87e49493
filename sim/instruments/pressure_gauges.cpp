// SPDX-License-Identifier: Apache-2.0
#include "sim/instruments/pressure_gauges.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace navcal::sim {
namespace {

namespace paroscientific = protocols::paroscientific;
namespace keller = protocols::keller;

constexpr double kBarometer_Pa = 101325;
constexpr double kSalt_kg_m3 = 1025;
constexpr std::int64_t kAnswersAfter_ns = 2'000'000;  ///< between a request and its answer
constexpr paroscientific::Address kToHost{paroscientific::kHost, paroscientific::kFirstGauge};

}  // namespace

double absolute_pressure_Pa(const State& state) {
  return kBarometer_Pa + kSalt_kg_m3 * kGravity_m_s2 * state.position_m[2];
}

void ParoscientificEmulator::power_on(std::int64_t) {
  forget();
  continuous_ = false;
  p3_ns_.reset();
}

void ParoscientificEmulator::obey(std::int64_t t_ns, const protocols::Frame& command) {
  if (paroscientific::address_of(command.bytes).to != paroscientific::kFirstGauge) return;
  continuous_ = false;
  p3_ns_.reset();
  const auto say = [&](const std::string& text) {
    answer(t_ns + kAnswersAfter_ns, paroscientific::encode_line(kToHost, text));
  };
  const std::string_view name = command.id.view();
  if (command.id == paroscientific::kUnits) say(fmt::format("UN={}", options_.unit));
  if (name == "VR") say("VR=R5.10");
  if (name == "P3") p3_ns_ = t_ns + std::llround(options_.integration_s * 1e9);
  if (command.id == paroscientific::kContinuous) {
    continuous_ = true;
    ticks_ = Ticks(t_ns, options_.integration_s, options_.clock_ppm);
  }
}

std::string ParoscientificEmulator::value(std::int64_t t_ns) {
  const std::int64_t middle_ns = t_ns - std::llround(options_.integration_s * 5e8);
  const double pressure_Pa = absolute_pressure_Pa(motion_.at(middle_ns)) + noise_.normal(options_.noise_Pa);
  return fmt::format("{:.5f}", pressure_Pa / paroscientific::unit_Pa(options_.unit).value_or(1));
}

std::int64_t ParoscientificEmulator::next_act_ns() const {
  return std::min(continuous_ ? ticks_.next_ns() : kNever_ns, p3_ns_.value_or(kNever_ns));
}

void ParoscientificEmulator::act(std::int64_t now_ns, std::vector<Emission>& out) {
  send(now_ns, paroscientific::encode_line(kToHost, value(now_ns)), out);
  if (!std::exchange(p3_ns_, std::nullopt)) ticks_.pass();
}

void KellerEmulator::power_on(std::int64_t) {
  forget();
  initialised_ = was_initialised_ = false;
}

void KellerEmulator::obey(std::int64_t t_ns, const protocols::Frame& command) {
  if (command.bytes[0] != options_.address && command.bytes[0] != keller::kAnyAddress) return;
  if (options_.echoes) answer(t_ns, Message(command.bytes.begin(), command.bytes.end()));
  if (auto bytes = reply_to(t_ns, command); !bytes.empty()) answer(t_ns + kAnswersAfter_ns, std::move(bytes));
}

std::vector<std::uint8_t> KellerEmulator::reply_to(std::int64_t t_ns, const protocols::Frame& request) {
  const std::uint8_t address = request.bytes[0];
  if (request.id == keller::kInitialiseRequest) {
    const std::uint8_t state = was_initialised_ ? 1 : 0;
    initialised_ = was_initialised_ = true;
    return keller::encode(keller::Identity{address, 5, 20, 12, 10, 13, state});
  }
  const auto channel = keller::requested_channel(request.bytes);
  if (!channel) return {};
  if (!initialised_)
    return keller::encode(keller::Refusal{address, keller::kReadChannel, keller::kNotInitialised});
  constexpr std::uint8_t kTemperature = 4, kNoSuchChannel = 2;
  const State state = motion_.at(t_ns);
  double value = 0;
  if (*channel == keller::kPressureChannel) {
    value = (absolute_pressure_Pa(state) + noise_.normal(options_.noise_Pa)) * 1e-5;
  } else if (*channel == kTemperature) {
    value = state.water_temperature_C;
  } else {
    return keller::encode(keller::Refusal{address, keller::kReadChannel, kNoSuchChannel});
  }
  return keller::encode(keller::Reading{address, static_cast<float>(value), 0});
}

}  // namespace navcal::sim
