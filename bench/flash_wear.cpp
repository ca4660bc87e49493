// SPDX-License-Identifier: Apache-2.0
// Writes a log at the vehicle's rates (41 records a second, each as raw bytes and as a sample) for a while, synced
// every second, and prints the bytes of the log. bench/flash_wear reads beside it what the device was told to
// write.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>

#include "config/load.h"
#include "record/log/log_encoder.h"
#include "record/log/log_folder.h"

namespace {

using namespace navcal;

struct Instrument {
  const char* name;
  protocols::Protocol protocol;
  int per_second;
  std::size_t frame_bytes;
};

constexpr Instrument kInstruments[] = {{"compass", protocols::Protocol::tcm2, 10, 51},
                                       {"imu", protocols::Protocol::imu_card, 20, 22},
                                       {"gps", protocols::Protocol::oncore, 1, 154},
                                       {"motor", protocols::Protocol::motor_card, 10, 45}};

instruments::Sample sample_of(std::uint16_t port, std::int64_t now_ns) {
  instruments::Sample sample;
  sample.port = port;
  sample.stamp = {now_ns, now_ns - 50'000'000, 1'234'567, now_ns, now_ns - 50'000'000};
  const double value = static_cast<double>(now_ns % 1'000'003) * 1e-6;
  const instruments::Vector3 vector{value, value, value};
  if (port == 0) {
    instruments::CompassSample compass;
    compass.heading_rad = compass.pitch_rad = compass.roll_rad = value;
    compass.field_body_uT = vector;
    sample.value = compass;
  } else if (port == 1) {
    instruments::ImuSample imu;
    imu.rate_rad_s = imu.specific_force_m_s2 = vector;
    imu.yaw_rate_b_rad_s = imu.depth_m = value;
    sample.value = imu;
  } else if (port == 2) {
    instruments::GpsSample gps;
    gps.latitude_rad = gps.longitude_rad = gps.speed_m_s = value;
    sample.value = gps;
  } else {
    instruments::MotorSample motor;
    motor.rpm_commanded = motor.rpm = motor.current_A = value;
    motor.fins_rad = {value, value, value};
    sample.value = motor;
  }
  return sample;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: bench_flash_wear FILE SECONDS\n");
    return 2;
  }
  config::Settings settings;
  for (const auto& i : kInstruments) settings.ports.push_back(config::default_port(i.name, i.protocol, 38400));
  record::LogEncoder encoder(settings, "");
  std::error_code error;
  const auto file = record::LogFile::create(record::real_disk(), argv[1], error);
  if (!file) return 1;
  std::string out;
  encoder.begin(out, 0, {});
  const std::string bytes(200, '\x5A');
  auto wake = std::chrono::steady_clock::now();
  for (int second = 0; second < std::atoi(argv[2]); ++second) {
    for (std::uint16_t port = 0; port < 4; ++port) {
      for (int k = 0; k < kInstruments[port].per_second; ++k) {
        const std::int64_t now_ns = second * 1'000'000'000LL + k * 50'000'000LL;
        encoder.raw(out, port, record::Direction::received, now_ns,
                    {reinterpret_cast<const std::uint8_t*>(bytes.data()), kInstruments[port].frame_bytes});
        encoder.sample(out, sample_of(port, now_ns));
      }
    }
    if (file->append(out) || file->sync()) return 1;
    out.clear();
    std::this_thread::sleep_until(wake += std::chrono::seconds(1));
  }
  encoder.finish(out, 0);
  if (file->append(out) || file->finish()) return 1;
  std::printf("%llu\n", static_cast<unsigned long long>(file->bytes()));
  return 0;
}
