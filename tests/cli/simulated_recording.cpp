// SPDX-License-Identifier: Apache-2.0
#include "tests/cli/simulated_recording.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "calib/correction.h"
#include "config/settings.h"
#include "protocols/oncore.h"
#include "protocols/oncore_command.h"
#include "protocols/tcm2.h"
#include "record/capture/capture_writer.h"
#include "sim/instruments/imu_card.h"
#include "sim/instruments/motor_card.h"
#include "sim/instruments/oncore.h"
#include "sim/instruments/tcm2.h"

namespace navcal::cli::test {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr double kRadians = std::numbers::pi / 180;

/// A read of one port, stamped when its last byte came.
struct Read {
  std::int64_t time_ns;
  std::uint16_t port;
  std::vector<std::uint8_t> bytes;
};

protocols::Bytes bytes_of(std::string_view text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

/// A word as a compass among iron would have said it.
std::vector<std::uint8_t> disturbed(const std::vector<std::uint8_t>& bytes, const RecordingOptions& options) {
  const auto word = protocols::tcm2::decode_word(bytes);
  if (!word || !word->field()) return bytes;
  const Eigen::Vector3d field = options.matrix * Eigen::Vector3d(word->field()->data()) + options.offset_uT;
  protocols::tcm2::Word other = *word;
  other.x = field.x();
  other.y = field.y();
  other.z = field.z();
  const double heading_rad = calib::levelled_heading(field, *word->roll * kRadians, *word->pitch * kRadians);
  other.heading = std::fmod(std::round(heading_rad / kRadians * 10) / 10, 360);
  return protocols::tcm2::encode_word(other);
}

void run(sim::Device& device, std::uint16_t port, const RecordingOptions& options, std::int64_t end_ns,
         std::vector<Read>& out) {
  std::vector<sim::Emission> emissions;
  while (device.next_event_ns() <= end_ns) device.advance(device.next_event_ns(), emissions);
  for (auto& emission : emissions) {
    if (port == 0) emission.bytes = disturbed(emission.bytes, options);
    const auto wire_ns = static_cast<std::int64_t>(emission.bytes.size()) * 10 * kSecond_ns / device.baud();
    out.push_back({emission.start_ns + wire_ns, port, std::move(emission.bytes)});
  }
}

template <class Device>
typename Device::Options seeded(std::uint64_t seed) {
  typename Device::Options options;
  options.seed = seed;
  return options;
}

config::PortSettings port(std::string name, protocols::Protocol protocol, int baud) {
  config::PortSettings settings;
  settings.name = std::move(name);
  settings.protocol = protocol;
  settings.baud = baud;
  return settings;
}

/// Level at the surface; turn rate in degrees a second as a function of time.
template <class Rate>
std::vector<sim::PathRow> path_of(double duration_s, Rate rate_deg_s) {
  constexpr double kRowStep_s = 0.1, kSpeed_m_s = 1;
  std::vector<sim::PathRow> rows;
  sim::PathRow row;
  for (int i = 0; i * kRowStep_s <= duration_s; ++i) {
    row.t_s = i * kRowStep_s;
    const double rate_rad_s = rate_deg_s(row.t_s) * kRadians;
    row.velocity_body_m_s = {kSpeed_m_s, 0, 0};
    row.rate_rad_s = {0, 0, rate_rad_s};
    row.rpm = 700;
    rows.push_back(row);
    // The rate goes straight from row to row.
    row.euler_rad[2] += (rate_rad_s + rate_deg_s(row.t_s + kRowStep_s) * kRadians) / 2 * kRowStep_s;
    row.position_m[0] += kSpeed_m_s * std::cos(row.euler_rad[2]) * kRowStep_s;
    row.position_m[1] += kSpeed_m_s * std::sin(row.euler_rad[2]) * kRowStep_s;
  }
  return rows;
}

}  // namespace

std::vector<sim::PathRow> turning_path(double duration_s) {
  return path_of(duration_s, [](double t_s) {
    const double phase_s = std::fmod(t_s, 60);
    return phase_s < 20 ? 20.0 : phase_s < 30 ? 0.0 : phase_s < 50 ? -24.0 : 8.0;
  });
}

std::vector<sim::PathRow> straight_path(double duration_s) {
  return path_of(duration_s, [](double) { return 0.0; });
}

std::string simulated_recording(const std::vector<sim::PathRow>& path, const RecordingOptions& options) {
  const std::int64_t begin_ns = options.begin_s * kSecond_ns;
  const std::int64_t end_ns = begin_ns + std::llround(options.duration_s * 1e9);
  const sim::PathMotion motion(path, begin_ns);
  std::vector<Read> reads;
  if (options.compass) {
    sim::Tcm2 compass(seeded<sim::Tcm2>(options.seed), motion);
    compass.power_on(begin_ns - kSecond_ns);
    for (const char* command : {"em=e\r", "go\r"}) compass.on_bytes(begin_ns, bytes_of(command));
    run(compass, 0, options, end_ns, reads);
  }
  if (options.imu) {
    auto card = seeded<sim::ImuCard>(options.seed + 1);
    card.card.scale[1] *= options.gyro_scale;
    sim::ImuCard imu(card, motion);
    imu.power_on(begin_ns);
    run(imu, 1, options, end_ns, reads);
  }
  if (options.gps) {
    sim::Oncore gps(seeded<sim::Oncore>(options.seed + 2), motion);
    gps.power_on(begin_ns);
    gps.on_bytes(begin_ns, protocols::oncore::encode_poll(protocols::FrameId("Ha"), 1));
    run(gps, 2, options, end_ns, reads);
  }
  if (options.motor) {
    sim::MotorCard card(seeded<sim::MotorCard>(options.seed + 3), motion);
    card.power_on(begin_ns);
    run(card, 3, options, end_ns, reads);
  }
  std::stable_sort(reads.begin(), reads.end(), [](const Read& a, const Read& b) { return a.time_ns < b.time_ns; });

  using protocols::Protocol;
  record::CaptureWriter writer({port("compass", Protocol::tcm2, 38400), port("imu", Protocol::imu_card, 57600),
                                port("gps", Protocol::oncore, 9600), port("motor", Protocol::motor_card, 19200)});
  std::string capture;
  writer.begin(capture);
  for (const Read& read : reads)
    writer.bytes(capture, read.port, record::Direction::received, read.time_ns, read.bytes);
  return capture;
}

}  // namespace navcal::cli::test
