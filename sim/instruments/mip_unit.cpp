// SPDX-License-Identifier: Apache-2.0
#include "sim/instruments/mip_unit.h"

#include <algorithm>
#include <cmath>

#include "base/angles.h"
#include "sim/rotation.h"

namespace navcal::sim {
namespace {

namespace mip = protocols::mip;
namespace command = mip::command_3dm;
namespace error = mip::reply_error;

constexpr std::uint16_t kBaseRate_Hz = 500;
constexpr std::int64_t kBaseTick_ns = 1'000'000'000 / kBaseRate_Hz;
constexpr std::int64_t kMipThinks_ns = 1'000'000;
constexpr std::int64_t kMipLatency_ns = 3'000'000;
constexpr std::int64_t kMipBuffer_ns = 50'000'000;  // a line that is further behind loses packets
/// Standard errors that the filter states; its angles have half of them.
constexpr double kTiltStd_rad = 0.2 * base::kRadiansPerDegree, kHeadingStd_rad = base::kRadiansPerDegree;
constexpr double kComplementaryNoise_rad = 0.1 * base::kRadiansPerDegree;
constexpr std::uint16_t kSolutionValid = 2;
constexpr std::uint8_t kReferenceTime = 0xD5;

bool has(const std::vector<std::uint8_t>& fields, std::uint8_t descriptor) {
  return std::ranges::find(fields, descriptor) != fields.end();
}

}  // namespace

void MipUnit::power_on(std::int64_t t_ns) {
  powered_ns_ = t_ns;
  forget();
  idle_ = false;
  streams_ = {};
  streams_[0].set = mip::kSensorSet;
  streams_[1].set = mip::kFilterSet;
  for (double& bias : bias_rad_s_) bias = noise_.normal(options_.imu.turn_on_bias_rad_s);
}

std::int64_t MipUnit::time_of(std::int64_t tick) const {
  const auto device_ns = tick * kBaseTick_ns;
  return powered_ns_ + device_ns + std::llround(static_cast<double>(device_ns) * options_.clock_ppm * 1e-6);
}

std::int64_t MipUnit::sent_ns(const Stream& stream) const { return time_of(stream.next_tick) + kMipLatency_ns; }

const MipUnit::Stream* MipUnit::first_due() const {
  const Stream* due = nullptr;
  for (const Stream& stream : streams_) {
    if (idle_ || !stream.on || stream.decimation == 0) continue;
    if (due == nullptr || stream.next_tick < due->next_tick) due = &stream;
  }
  return due;
}

std::int64_t MipUnit::next_act_ns() const {
  const Stream* const due = first_due();
  return due != nullptr ? sent_ns(*due) : kNever_ns;
}

void MipUnit::act(std::int64_t now_ns, std::vector<Emission>& out) {
  const Stream* const due = first_due();
  if (line_.free_ns() < now_ns + kMipBuffer_ns) send(now_ns, packet(*due), out);
  stream_of(due->set)->next_tick += due->decimation;
}

MipUnit::Stream* MipUnit::stream_of(std::uint8_t set) {
  for (Stream& stream : streams_) {
    if (stream.set == set && (set != mip::kFilterSet || options_.has_filter)) return &stream;
  }
  return nullptr;
}

void MipUnit::obey(std::int64_t t_ns, const protocols::Frame& frame) {
  const std::uint8_t set = frame.bytes[2];
  for (const auto& field : mip::fields_of(frame.bytes)) {
    std::uint8_t outcome = error::kUnknownCommand;
    if (set == mip::kBaseSet) outcome = obey_base(t_ns, field.descriptor);
    if (set == mip::k3dmSet) outcome = obey_3dm(t_ns, field.descriptor, field.data);
    const mip::Reply reply{field.descriptor, outcome};
    const bool asks_rate = field.descriptor == command::kBaseRate ||
                           field.descriptor == command::kSensorBaseRate ||
                           field.descriptor == command::kFilterBaseRate;
    const std::uint8_t of_set = field.data.empty() ? std::uint8_t{0} : field.data[0];
    answer(t_ns + kMipThinks_ns, set == mip::k3dmSet && asks_rate && outcome == error::kNone
                                     ? mip::encode_base_rate(reply, {of_set, kBaseRate_Hz})
                                     : mip::encode_reply(set, reply));
  }
}

std::uint8_t MipUnit::obey_base(std::int64_t t_ns, std::uint8_t base_command) {
  switch (static_cast<mip::BaseCommand>(base_command)) {
    case mip::BaseCommand::ping: return error::kNone;
    case mip::BaseCommand::set_to_idle: idle_ = true; return error::kNone;
    case mip::BaseCommand::resume:
      idle_ = false;
      for (Stream& stream : streams_) begin_stream(stream, t_ns);
      return error::kNone;
  }
  return error::kUnknownCommand;
}

std::uint8_t MipUnit::obey_3dm(std::int64_t t_ns, std::uint8_t command_3dm, protocols::Bytes data) {
  switch (command_3dm) {
    case command::kSensorBaseRate: return error::kNone;
    case command::kFilterBaseRate: return options_.has_filter ? error::kNone : error::kUnknownCommand;
    case command::kSensorFormat:
    case command::kFilterFormat:
      if (data.size() < 2) return error::kInvalidParameter;
      return set_format(t_ns, command_3dm == command::kSensorFormat ? mip::kSensorSet : mip::kFilterSet,
                        data.subspan(1));
    case command::kBaseRate:
      if (!options_.newer_commands) return error::kUnknownCommand;
      return !data.empty() && stream_of(data[0]) != nullptr ? error::kNone : error::kInvalidParameter;
    case command::kFormat:
      if (!options_.newer_commands) return error::kUnknownCommand;
      if (data.size() < 3) return error::kInvalidParameter;
      return set_format(t_ns, data[1], data.subspan(2));
    case command::kDataStream:
      if (data.size() < 3) return error::kInvalidParameter;
      return set_stream(t_ns, data[1], data[2] != 0);
    default: return error::kUnknownCommand;
  }
}

bool MipUnit::knows(std::uint8_t set, std::uint8_t descriptor) const {
  if (descriptor == kReferenceTime) return options_.newer_commands;
  if (set == mip::kFilterSet) return has({0x05, 0x0A, 0x10, 0x11}, descriptor);
  if (descriptor == 0x0C) return options_.has_complementary;
  return has({0x04, 0x05, 0x06, 0x12}, descriptor);
}

std::uint8_t MipUnit::set_format(std::int64_t t_ns, std::uint8_t set, protocols::Bytes list) {
  Stream* const stream = stream_of(set);
  const auto rates = mip::decode_format(list);
  if (stream == nullptr || rates.empty()) return error::kInvalidParameter;
  std::vector<std::uint8_t> fields;
  for (const auto& rate : rates) {
    // This unit has one rate for all fields of a set.
    if (!knows(set, rate.descriptor) || rate.decimation == 0 || rate.decimation != rates[0].decimation) {
      return error::kInvalidParameter;
    }
    fields.push_back(rate.descriptor);
  }
  stream->fields = fields;
  stream->decimation = rates[0].decimation;
  begin_stream(*stream, t_ns);
  return error::kNone;
}

std::uint8_t MipUnit::set_stream(std::int64_t t_ns, std::uint8_t selector, bool on) {
  constexpr std::uint8_t kOldSensor = 1, kOldFilter = 3;
  Stream* const stream = stream_of(selector == kOldSensor   ? mip::kSensorSet
                                   : selector == kOldFilter ? mip::kFilterSet
                                                            : selector);
  if (stream == nullptr) return error::kInvalidParameter;
  stream->on = on;
  begin_stream(*stream, t_ns);
  return error::kNone;
}

/// The next packet is the first whole multiple of the decimation from now on.
void MipUnit::begin_stream(Stream& stream, std::int64_t t_ns) const {
  if (stream.decimation == 0) return;
  const std::int64_t period_ns = stream.decimation * kBaseTick_ns;
  stream.next_tick = ((t_ns - powered_ns_) / period_ns + 1) * stream.decimation;
}

std::vector<std::uint8_t> MipUnit::packet(const Stream& stream) {
  mip::Packet packet;
  packet.set = stream.set;
  const std::int64_t device_ns = stream.next_tick * kBaseTick_ns;
  if (has(stream.fields, kReferenceTime)) packet.reference_time_ns = static_cast<std::uint64_t>(device_ns);
  if (has(stream.fields, stream.set == mip::kFilterSet ? 0x11 : 0x12)) {
    packet.gps_time = mip::GpsTime{static_cast<double>(device_ns) * 1e-9, 0, false, false};
  }
  const State state = motion_.at(time_of(stream.next_tick));
  if (stream.set == mip::kSensorSet) {
    put_sensor(stream.fields, state, packet);
  } else {
    put_filter(stream.fields, state, packet);
  }
  return mip::encode(packet);
}

void MipUnit::put_sensor(const std::vector<std::uint8_t>& fields, const State& state, mip::Packet& packet) {
  if (has(fields, 0x04))
    packet.acceleration_m_s2 = noisy(state.specific_force_m_s2, options_.imu.force_noise_m_s2);
  if (has(fields, 0x05)) {
    packet.rate_rad_s = noisy(state.rate_rad_s, options_.imu.gyro_noise_rad_s);
    for (std::size_t i = 0; i < 3; ++i) (*packet.rate_rad_s)[i] += bias_rad_s_[i];
  }
  if (has(fields, 0x06)) {
    packet.field_uT = noisy(transpose(R_world_from_body(state.euler_rad)) * state.field_world_uT,
                            options_.compass.field_noise_uT);
  }
  if (has(fields, 0x0C)) {
    packet.euler_rad = noisy(state.euler_rad, kComplementaryNoise_rad);
    const double declination_rad = std::atan2(state.field_world_uT[1], state.field_world_uT[0]);
    (*packet.euler_rad)[2] = base::wrapped((*packet.euler_rad)[2] - declination_rad);
  }
}

void MipUnit::put_filter(const std::vector<std::uint8_t>& fields, const State& state, mip::Packet& packet) {
  if (has(fields, 0x05)) {
    const Vector3& euler_rad = state.euler_rad;
    packet.filter_euler_rad =
        mip::Triple{euler_rad[0] + noise_.normal(kTiltStd_rad / 2), euler_rad[1] + noise_.normal(kTiltStd_rad / 2),
                    base::wrapped(euler_rad[2] + noise_.normal(kHeadingStd_rad / 2))};
  }
  if (has(fields, 0x0A)) packet.filter_euler_std_rad = mip::Triple{kTiltStd_rad, kTiltStd_rad, kHeadingStd_rad};
  if (has(fields, 0x10)) packet.filter_state = kSolutionValid;
}

}  // namespace navcal::sim
