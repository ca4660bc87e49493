// SPDX-License-Identifier: Apache-2.0
#include "sim/instruments/ubx_receiver.h"

#include <algorithm>
#include <cmath>

#include "base/durations.h"
#include "protocols/ubx_receiver.h"
#include "sim/instruments/oncore_messages.h"
#include "sim/instruments/ubx_messages.h"

namespace navcal::sim {
namespace {

namespace ubx = protocols::ubx;

constexpr std::int64_t kUbxReply_ns = 20 * base::kMillisecond_ns;  // from a command to its answer

/// The messages that it can send, in the order in which it sends them.
constexpr ubx::MessageCode kUbxMessages[] = {ubx::kNavDop, ubx::kNavPvt, ubx::kNavTimeGps, ubx::kNavSat};

bool is_sentence(ubx::MessageCode code) { return code >> 8 == 0xF0; }

}  // namespace

UbxReceiver::UbxReceiver(const Options& options, const Motion& motion)
    : CommandedDevice(options.baud), options_(options), receiver_(options.receiver, motion, options.seed) {}

std::int64_t UbxReceiver::latency_ns() const { return std::llround(options_.receiver.gps.timing.latency_s * 1e9); }

void UbxReceiver::power_on(std::int64_t t_ns) {
  receiver_.power_on(t_ns);
  forget();
  configuration_ = {};
  epoch_ns_ = (t_ns / base::kSecond_ns + 1) * base::kSecond_ns;
  epochs_ = 0;
  ever_fixed_ = false;
}

void UbxReceiver::obey(std::int64_t t_ns, const protocols::Frame& command) {
  const auto code = ubx::code_of(command).value_or(0);
  const std::int64_t due_ns = t_ns + kUbxReply_ns;
  if (code == ubx::kMonVer) answer(due_ns, version_message(options_.generation == Generation::nine));
  if (code >> 8 != 0x06) return;
  bool accepted = false;
  if (const auto values = ubx::decode_cfg_valset(command.bytes)) {
    accepted = options_.generation == Generation::nine && set(*values);
  } else if (const auto rate = ubx::decode_cfg_msg(command.bytes)) {
    accepted = set(*rate);
  } else if (const auto epochs = ubx::decode_cfg_rate(command.bytes)) {
    accepted = epochs->interval_ms >= 25;
    if (accepted) configuration_.interval_ns = epochs->interval_ms * base::kMillisecond_ns;
  }
  answer(due_ns, ubx::encode_acknowledgement({code, accepted}));
}

bool UbxReceiver::set(const ubx::ValueSet& values) {
  Configuration wanted = configuration_;
  for (const auto& [key, value] : values.items) {
    bool known = key == ubx::kRateMeasurement_ms || key == ubx::kRateNavigation;
    if (key == ubx::kRateMeasurement_ms)
      wanted.interval_ns = static_cast<std::int64_t>(value) * base::kMillisecond_ns;
    for (const auto port : {ubx::ReceiverPort::uart1, ubx::ReceiverPort::uart2, ubx::ReceiverPort::usb}) {
      const bool here = port == options_.port;
      if (key == ubx::key_of_ubx_output(port)) {
        known = true;
        if (here) wanted.ubx = value != 0;
      }
      if (key == ubx::key_of_nmea_output(port)) {
        known = true;
        if (here) wanted.nmea = value != 0;
      }
      for (const ubx::MessageCode code : kUbxMessages) {
        if (key != ubx::key_of_message(code, port)) continue;
        known = true;
        if (here) wanted.epochs[code] = static_cast<std::uint8_t>(value);
      }
    }
    if (!known) return false;  // one unknown key, and nothing is set
  }
  configuration_ = wanted;
  return true;
}

bool UbxReceiver::set(const ubx::MessageRate& rate) {
  if (is_sentence(rate.code)) {
    // Enough for a start-up that turns all of them off.
    if (rate.epochs == 0) configuration_.nmea = false;
    return true;
  }
  const bool has =
      options_.generation != Generation::six || (rate.code != ubx::kNavPvt && rate.code != ubx::kNavSat);
  const bool known =
      std::find(std::begin(kUbxMessages), std::end(kUbxMessages), rate.code) != std::end(kUbxMessages);
  if (!has || !known) return false;
  configuration_.epochs[rate.code] = rate.epochs;
  return true;
}

std::vector<std::uint8_t> UbxReceiver::message(MessageCode code, const GpsReading& reading) const {
  const UbxEpoch epoch{epoch_ns_, options_.clock_error_ns, options_.leap_seconds, ever_fixed_};
  if (code == ubx::kNavDop) return dop_message(reading, epoch);
  if (code == ubx::kNavPvt) return pvt_message(reading, epoch, options_.receiver.gps);
  if (code == ubx::kNavTimeGps) return timegps_message(epoch);
  return sat_message(reading, epoch);
}

void UbxReceiver::act(std::int64_t now_ns, std::vector<Emission>& out) {
  GpsReading reading = receiver_.measure(epoch_ns_ + options_.clock_error_ns);
  reading.utc_ns = epoch_ns_;
  ever_fixed_ = ever_fixed_ || reading.fixed;
  if (configuration_.nmea) {
    send(now_ns, nmea_sentences(reading, {epoch_ns_, options_.leap_seconds, true}), out);
  }
  for (const MessageCode code : kUbxMessages) {
    const auto wanted = configuration_.epochs.find(code);
    if (!configuration_.ubx || wanted == configuration_.epochs.end() || wanted->second == 0) continue;
    if (epochs_ % wanted->second == 0) send(now_ns, message(code, reading), out);
  }
  ++epochs_;
  epoch_ns_ += configuration_.interval_ns;
}

}  // namespace navcal::sim
