// SPDX-License-Identifier: Apache-2.0
// Bytes to samples by a description beside the same bytes through the built-in driver, alternated in one run. The
// counter `ratio` is the description's time over the driver's; the goal is at most 2.
#include <benchmark/benchmark.h>
#include <time.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "config/described/description_file.h"
#include "config/load.h"
#include "instruments/instrument.h"
#include "protocols/checked_line.h"
#include "protocols/imu_card.h"
#include "protocols/parsers.h"

namespace navcal::bench {
namespace {

using protocols::Bytes;
using Buffer = std::vector<std::uint8_t>;

constexpr std::size_t kStreamLength = 1 << 18;
constexpr std::size_t kReadLength = 4096;

Buffer card_stream() {
  Buffer stream;
  for (unsigned i = 0; stream.size() < kStreamLength; ++i) {
    protocols::imu_card::Record record{static_cast<std::uint8_t>(i), 0, {}};
    for (unsigned c = 0; c < record.raw.size(); ++c)
      record.raw[c] = static_cast<std::uint16_t>(32768 + 37 * i * c % 999);
    const auto frame = protocols::imu_card::encode_record(record);
    stream.insert(stream.end(), frame.begin(), frame.end());
  }
  return stream;
}

Buffer depth_stream() {
  Buffer stream;
  for (unsigned i = 0; stream.size() < kStreamLength; ++i) {
    const auto line =
        protocols::checked_line("IIDPT," + std::to_string(i % 300) + "." + std::to_string(i % 10) + ",0.3,");
    stream.insert(stream.end(), line.begin(), line.end());
  }
  return stream;
}

struct Count : instruments::Receiver {
  void on_measurement(const instruments::Measurement& measurement) override {
    benchmark::DoNotOptimize(&measurement);
    ++measurements;
  }
  std::uint64_t measurements = 0;
};

/// Decodes a stream as a port does; returns the number of samples.
std::uint64_t decode(const config::PortSettings& port, Bytes stream) {
  auto parser = protocols::make_port_parser(port.protocol, port.described ? &*port.described : nullptr);
  const auto instrument = instruments::make_instrument(port);
  Count count;
  for (; !stream.empty(); stream = stream.subspan(std::min(kReadLength, stream.size()))) {
    const Bytes read = stream.first(std::min(kReadLength, stream.size()));
    std::visit(
        [&](auto& any) { any.feed(read, [&](const protocols::Frame& frame) { instrument->read(frame, count); }); },
        parser);
  }
  return count.measurements;
}

/// CPU time of this thread alone, so that a busy machine does not disturb the comparison.
double cpu_time_s() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

void compare(benchmark::State& state, protocols::Protocol protocol, const std::string& file,
             const Buffer& stream) {
  const auto built_in = config::default_port("built_in", protocol, 9600);
  auto described = config::default_port("described", protocols::Protocol::described, 9600);
  described.described = config::load_description(NAVCAL_SOURCE_DIR "/share/devices/" + file);
  double driver_s = 0, description_s = 0;
  for ([[maybe_unused]] auto _ : state) {
    const double began_s = cpu_time_s();
    const std::uint64_t by_driver = decode(built_in, stream);
    const double between_s = cpu_time_s();
    const std::uint64_t by_description = decode(described, stream);
    const double ended_s = cpu_time_s();
    if (by_driver == 0 || by_driver != by_description) state.SkipWithError("driver and description differ");
    driver_s += between_s - began_s;
    description_s += ended_s - between_s;
    state.SetIterationTime(ended_s - between_s);
  }
  const double megabytes = static_cast<double>(stream.size()) * static_cast<double>(state.iterations()) / 1e6;
  state.counters["MB/s"] = megabytes / description_s;
  state.counters["driver_MB/s"] = megabytes / driver_s;
  state.counters["ratio"] = description_s / driver_s;
}

}  // namespace
}  // namespace navcal::bench

int main(int argc, char** argv) {
  using namespace navcal;
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RegisterBenchmark("inertial_card", [](benchmark::State& state) {
    bench::compare(state, protocols::Protocol::imu_card, "thesis-imu-card.toml", bench::card_stream());
  })->UseManualTime();
  benchmark::RegisterBenchmark("nmea_dpt", [](benchmark::State& state) {
    bench::compare(state, protocols::Protocol::nmea, "nmea-dpt.toml", bench::depth_stream());
  })->UseManualTime();
  benchmark::RunSpecifiedBenchmarks();
}
