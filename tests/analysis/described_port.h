// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <string_view>
#include <vector>

#include "config/load.h"
#include "pipeline/pipeline.h"
#include "sim/instruments/emulators.h"
#include "tests/sim/drive.h"
#include "tests/support/temporary_folder.h"

// Ports of described devices, and a recording of the emulated inertial card.
namespace navcal::analysis::described {

using instruments::Sample;
using sim::testing::kSecond_ns;
using sim::testing::kStart_ns;
using Octets = std::vector<std::uint8_t>;

inline const std::filesystem::path kShipped = NAVCAL_SOURCE_DIR "/share/devices";

inline config::PortSettings described_port(const std::filesystem::path& file) {
  const navcal::test::TemporaryFolder folder;
  std::ofstream(folder / "navcald.toml")
      << "[port.device]\nprotocol = \"described\"\npath = \"/dev/ttyS0\"\ndevice = \"" << file.native() << "\"\n";
  return config::load(folder / "navcald.toml").ports.at(0);
}

inline config::PortSettings described_port_of(std::string_view toml) {
  const navcal::test::TemporaryFolder folder;
  std::ofstream(folder / "device.toml") << toml;
  return described_port(folder / "device.toml");
}

inline config::PortSettings built_in_port(protocols::Protocol protocol) {
  return config::default_port("device", protocol, config::default_baud(protocol));
}

struct Read {
  std::int64_t arrival_ns = 0;
  Octets bytes;
};

/// What the pipeline makes of reads.
struct Samples : pipeline::Sink {
  explicit Samples(const config::PortSettings& port) : pipeline(settings_of(port)) {}
  static config::Settings settings_of(const config::PortSettings& port) {
    config::Settings settings;
    settings.ports.push_back(port);
    return settings;
  }
  void take(const std::vector<Read>& reads) {
    for (const Read& read : reads) pipeline.bytes(0, read.arrival_ns, read.bytes, *this);
  }
  void on_sample(const Sample& sample) override { samples.push_back(sample); }

  pipeline::Pipeline pipeline;
  std::vector<Sample> samples;
};

/// A vehicle that turns, pitches and dives, so that all channels move.
struct Moving : sim::testing::Still {
  [[nodiscard]] sim::State at(std::int64_t t_ns) const override {
    sim::State now = state;
    const double t_s = static_cast<double>(t_ns - kStart_ns) * 1e-9;
    now.position_m[2] = 3 + 2 * std::sin(t_s / 7);
    now.rate_rad_s = {0.3 * std::sin(t_s), 0.2 * std::cos(2 * t_s), 0.5 * std::sin(t_s / 3)};
    return now;
  }
};

/// A recording of the emulated inertial card, cut into reads that do not keep to its frames.
inline std::vector<Read> card_recording(int seconds) {
  const Moving motion;
  const auto emulator = sim::make_emulator(protocols::Protocol::imu_card, {}, motion);
  emulator->power_on(kStart_ns);
  std::vector<Read> reads;
  std::mt19937_64 random(3);  // NOLINT: the same reads in every run
  std::int64_t now_ns = kStart_ns;
  for (std::int64_t t_ns = kStart_ns; t_ns < kStart_ns + seconds * kSecond_ns; t_ns += kSecond_ns / 50) {
    std::vector<sim::Emission> emissions;
    emulator->advance(t_ns, emissions);
    for (const sim::Emission& emission : emissions) {
      now_ns = std::max(now_ns + 1, emission.start_ns + 5'000'000);
      const std::size_t cut = random() % (emission.bytes.size() + 1);
      reads.push_back(
          {now_ns, Octets(emission.bytes.begin(), emission.bytes.begin() + static_cast<std::ptrdiff_t>(cut))});
      reads.push_back({now_ns + 400'000,
                       Octets(emission.bytes.begin() + static_cast<std::ptrdiff_t>(cut), emission.bytes.end())});
      now_ns += 400'000;
    }
  }
  std::erase_if(reads, [](const Read& read) { return read.bytes.empty(); });
  return reads;
}

inline Octets bytes_of_reads(const std::vector<Read>& reads) {
  Octets all;
  for (const Read& read : reads) all.insert(all.end(), read.bytes.begin(), read.bytes.end());
  return all;
}

}  // namespace navcal::analysis::described
