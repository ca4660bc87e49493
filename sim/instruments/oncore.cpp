// SPDX-License-Identifier: Apache-2.0
#include "sim/instruments/oncore.h"

#include <cmath>

#include "base/durations.h"
#include "protocols/oncore_command.h"
#include "sim/instruments/oncore_messages.h"

namespace navcal::sim {
namespace {

namespace oncore = protocols::oncore;
constexpr std::int64_t kWeek_ns = 7 * 86400LL * base::kSecond_ns;
constexpr std::size_t kInputBytes = 1024;
constexpr double kUsefulPosition_deg = 1;
constexpr std::int64_t kUsefulTime_ns = 600 * base::kSecond_ns;

}  // namespace

Oncore::Oncore(const Options& options, const Motion& motion)
    : LineDevice(options.baud), options_(options), receiver_(options.receiver, motion, options.seed) {}

std::int64_t Oncore::latency_ns() const { return std::llround(options_.receiver.gps.timing.latency_s * 1e9); }

void Oncore::power_on(std::int64_t t_ns) {
  receiver_.power_on(t_ns);
  input_.clear();
  parser_ = {};
  requests_.clear();
  second_ns_ = (t_ns / base::kSecond_ns + 1) * base::kSecond_ns;
}

void Oncore::on_bytes(std::int64_t /*t_ns*/, protocols::Bytes bytes) {
  // Kept until the receiver gets round to it; what its buffer does not hold is lost.
  const std::size_t room = kInputBytes - std::min(kInputBytes, input_.size());
  const auto kept = bytes.first(std::min(bytes.size(), room));
  input_.insert(input_.end(), kept.begin(), kept.end());
}

bool Oncore::knows(protocols::FrameId id) const {
  if (id == oncore::kHa) return options_.kind == Kind::twelve_channels;
  return id == oncore::kEa || id == oncore::kBb || id == oncore::kBo || id == oncore::kCj;
}

void Oncore::read_input(std::vector<Emission>& out) {
  parser_.feed(input_, [&](const protocols::Frame& frame) {
    const auto command = oncore::parse_command(frame.bytes);
    if (command && command->id == oncore::kCf) {
      requests_.clear();
      receiver_.power_on(second_ns_);  // it has forgotten as much as after a loss of power
      send(next_act_ns(), {frame.bytes.begin(), frame.bytes.end()}, out);
    }
    if (command && knows(command->id)) requests_[command->id] = {command->rate.value_or(0), 0};
    if (!command && options_.kind == Kind::twelve_channels) take_aid(frame.bytes, out);
  });
  input_.clear();
}

void Oncore::take_aid(protocols::Bytes frame, std::vector<Emission>& out) {
  const auto position = oncore::parse_aid_position(frame);
  const auto utc_ns = oncore::parse_aid_time(frame);
  if (!position && !utc_ns) return;
  send(next_act_ns(), {frame.begin(), frame.end()}, out);
  // A position far from the true one does not help: other satellites are in view there.
  if (position && std::abs(position->latitude_deg - options_.receiver.origin.latitude_deg) < kUsefulPosition_deg &&
      std::abs(std::remainder(position->longitude_deg - options_.receiver.origin.longitude_deg, 360)) <
          kUsefulPosition_deg)
    receiver_.learn_position();
  if (utc_ns && std::abs(*utc_ns - second_ns_) < kUsefulTime_ns) receiver_.learn_time();
}

std::vector<std::uint8_t> Oncore::message(protocols::FrameId id, const GpsReading& reading) const {
  const std::int64_t ahead_ns = options_.leap_seconds_known ? 0 : options_.leap_seconds * base::kSecond_ns;
  const ReceiverTime time{reading.utc_ns + ahead_ns - options_.weeks_early * kWeek_ns, options_.leap_seconds,
                          options_.leap_seconds_known};
  if (options_.kind == Kind::nmea) return nmea_sentences(reading, time);
  if (id == oncore::kHa) return ha_message(reading, time);
  if (id == oncore::kEa) return ea_message(reading, time);
  if (id == oncore::kBb) return bb_message();
  if (id == oncore::kBo) return bo_message(time);
  return cj_message();
}

void Oncore::act(std::int64_t now_ns, std::vector<Emission>& out) {
  const GpsReading reading = receiver_.measure(second_ns_);
  if (options_.kind == Kind::nmea) {
    input_.clear();
    send(now_ns, message({}, reading), out);
  } else {
    read_input(out);
    // The position first: it is what is waited for.
    const auto is_position = [](const auto& entry) {
      return entry.first == oncore::kHa || entry.first == oncore::kEa;
    };
    for (const bool positions : {true, false}) {
      for (auto& entry : requests_) {
        if (is_position(entry) != positions) continue;
        auto& [id, request] = entry;
        if (request.wait_s == 0) {
          send(now_ns, message(id, reading), out);
          request.wait_s = request.every_s;
        }
        --request.wait_s;
      }
    }
    std::erase_if(requests_, [](const auto& entry) { return entry.second.every_s == 0; });
  }
  second_ns_ += base::kSecond_ns;
}

}  // namespace navcal::sim
