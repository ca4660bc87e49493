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

/// Puts the answers that are due on the line.
void send_due(std::int64_t t_ns, int baud, std::vector<Emission>& answers, Line& line,
              std::vector<Emission>& out) {
  const auto due = std::stable_partition(answers.begin(), answers.end(),
                                         [&](const Emission& answer) { return answer.start_ns <= t_ns; });
  for (auto answer = answers.begin(); answer != due; ++answer)
    line.put(answer->start_ns, baud, std::move(answer->bytes), out);
  answers.erase(answers.begin(), due);
}

std::int64_t first_due_ns(const std::vector<Emission>& answers) {
  std::int64_t first_ns = kNever_ns;
  for (const Emission& answer : answers) first_ns = std::min(first_ns, answer.start_ns);
  return first_ns;
}

}  // namespace

double absolute_pressure_Pa(const State& state) {
  return kBarometer_Pa + kSalt_kg_m3 * kGravity_m_s2 * state.position_m[2];
}

ParoscientificEmulator::ParoscientificEmulator(const Options& options, const Motion& motion)
    : options_(options), motion_(motion), noise_(options.seed) {}

void ParoscientificEmulator::power_on(std::int64_t) {
  parser_ = {};
  ticks_.reset();
  p3_ns_.reset();
  answers_.clear();
}

void ParoscientificEmulator::on_bytes(std::int64_t t_ns, protocols::Bytes bytes) {
  parser_.feed(bytes, [&](const protocols::Frame& frame) { obey(t_ns, frame); });
}

void ParoscientificEmulator::obey(std::int64_t t_ns, const protocols::Frame& command) {
  if (paroscientific::address_of(command.bytes).to != paroscientific::kFirstGauge) return;
  ticks_.reset();
  p3_ns_.reset();
  const auto say = [&](const std::string& text) {
    answers_.push_back({t_ns + kAnswersAfter_ns, paroscientific::encode_line(kToHost, text)});
  };
  const std::string_view name = command.id.view();
  if (command.id == paroscientific::kUnits) say(fmt::format("UN={}", options_.unit));
  if (name == "VR") say("VR=R5.10");
  if (name == "P3") p3_ns_ = t_ns + std::llround(options_.integration_s * 1e9);
  if (command.id == paroscientific::kContinuous) ticks_ = Ticks(t_ns, options_.integration_s, options_.clock_ppm);
}

std::string ParoscientificEmulator::value(std::int64_t t_ns) {
  const std::int64_t middle_ns = t_ns - std::llround(options_.integration_s * 5e8);
  const double pressure_Pa = absolute_pressure_Pa(motion_.at(middle_ns)) + noise_.normal(options_.noise_Pa);
  return fmt::format("{:.5f}", pressure_Pa / paroscientific::unit_Pa(options_.unit).value_or(1));
}

std::int64_t ParoscientificEmulator::next_event_ns() const {
  return std::min({first_due_ns(answers_), ticks_ ? ticks_->next_ns() : kNever_ns, p3_ns_.value_or(kNever_ns)});
}

void ParoscientificEmulator::advance(std::int64_t t_ns, std::vector<Emission>& out) {
  send_due(t_ns, options_.baud, answers_, line_, out);
  if (p3_ns_ && *p3_ns_ <= t_ns) {
    const std::int64_t due_ns = *std::exchange(p3_ns_, std::nullopt);
    line_.put(due_ns, options_.baud, paroscientific::encode_line(kToHost, value(due_ns)), out);
  }
  while (ticks_ && ticks_->next_ns() <= t_ns) {
    const std::int64_t due_ns = ticks_->next_ns();
    line_.put(due_ns, options_.baud, paroscientific::encode_line(kToHost, value(due_ns)), out);
    ticks_->pass();
  }
}

KellerEmulator::KellerEmulator(const Options& options, const Motion& motion)
    : options_(options), motion_(motion), noise_(options.seed) {}

void KellerEmulator::power_on(std::int64_t) {
  parser_ = {};
  initialised_ = was_initialised_ = false;
  answers_.clear();
}

void KellerEmulator::on_bytes(std::int64_t t_ns, protocols::Bytes bytes) {
  parser_.feed(bytes, [&](const protocols::Frame& frame) {
    if (frame.bytes[0] != options_.address && frame.bytes[0] != keller::kAnyAddress) return;
    if (options_.echoes) answers_.push_back({t_ns, {frame.bytes.begin(), frame.bytes.end()}});
    if (auto bytes_to_send = answer(t_ns, frame); !bytes_to_send.empty())
      answers_.push_back({t_ns + kAnswersAfter_ns, std::move(bytes_to_send)});
  });
}

std::vector<std::uint8_t> KellerEmulator::answer(std::int64_t t_ns, const protocols::Frame& request) {
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

std::int64_t KellerEmulator::next_event_ns() const { return first_due_ns(answers_); }

void KellerEmulator::advance(std::int64_t t_ns, std::vector<Emission>& out) {
  send_due(t_ns, options_.baud, answers_, line_, out);
}

}  // namespace navcal::sim
