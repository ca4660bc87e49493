// SPDX-License-Identifier: Apache-2.0
// Framing and checksum of each protocol beside a byte-wise XOR loop over the same bytes, alternated in one run.
// The counter `ratio` is the parser's time over the loop's; the goal is at most 4.
#include <benchmark/benchmark.h>
#include <time.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "bench/xor_reference.h"
#include "protocols/checked_line.h"
#include "protocols/imu_card.h"
#include "protocols/keller.h"
#include "protocols/mip.h"
#include "protocols/motor_card.h"
#include "protocols/nmea.h"
#include "protocols/oncore.h"
#include "protocols/paroscientific.h"
#include "protocols/pd0.h"
#include "protocols/pd6.h"
#include "protocols/samples_line.h"
#include "protocols/tcm2.h"
#include "protocols/trax.h"
#include "protocols/ubx_navigation.h"
#include "protocols/vectornav.h"
#include "protocols/water_linked.h"

namespace navcal::bench {
namespace {

using protocols::Bytes;
using Buffer = std::vector<std::uint8_t>;

constexpr std::size_t kStreamLength = 1 << 18;
constexpr std::size_t kReadLength = 4096;

template <class Frame>
void append(Buffer& stream, const Frame& frame) {
  stream.insert(stream.end(), frame.begin(), frame.end());
}

/// Repeats `make(i)` until the stream is long enough.
template <class Make>
Buffer stream_of(Make make) {
  Buffer stream;
  for (unsigned i = 0; stream.size() < kStreamLength; ++i) append(stream, make(i));
  return stream;
}

Buffer tcm2_stream() {
  return stream_of([](unsigned i) {
    const double turn = i * 0.01;
    protocols::tcm2::Word word{std::fmod(i * 0.7, 360.0),
                               20 * std::sin(turn),
                               10 * std::cos(turn),
                               20 * std::cos(turn),
                               20 * std::sin(turn),
                               43.21,
                               18.5,
                               std::nullopt};
    return protocols::tcm2::encode_word(word);
  });
}

Buffer imu_card_stream() {
  return stream_of([](unsigned i) {
    protocols::imu_card::Record record{static_cast<std::uint8_t>(i), 0, {}};
    for (unsigned c = 0; c < record.raw.size(); ++c)
      record.raw[c] = static_cast<std::uint16_t>(32768 + 37 * i * c % 999);
    return protocols::imu_card::encode_record(record);
  });
}

Buffer motor_card_stream() {
  return stream_of([](unsigned i) {
    const auto rpm = static_cast<std::int32_t>(i % 1500);
    return protocols::motor_card::encode_status(
        {static_cast<std::uint8_t>(i), 1500, rpm, {-2.5, (i % 200) / 10.0 - 10, 12.0}, 3.25});
  });
}

/// Messages of a receiver in one second: Ha, Bb and Bo, with arbitrary content.
Buffer oncore_stream() {
  return stream_of([](unsigned i) {
    Buffer second;
    for (const std::string_view id : {"Ha", "Bb", "Bo"}) {
      Buffer frame(
          protocols::oncore::response_length(static_cast<std::uint8_t>(id[0]), static_cast<std::uint8_t>(id[1])));
      for (std::size_t k = 0; k < frame.size(); ++k) frame[k] = static_cast<std::uint8_t>((i + 7 * k) % 251);
      frame[0] = frame[1] = '@';
      std::copy(id.begin(), id.end(), frame.begin() + 2);
      frame[frame.size() - 3] = protocols::xor_of(Bytes(frame).subspan(2, frame.size() - 5));
      frame[frame.size() - 2] = '\r';
      frame[frame.size() - 1] = '\n';
      append(second, frame);
    }
    return second;
  });
}

Buffer nmea_stream() {
  return stream_of([](unsigned i) {
    const std::string seconds = std::to_string(10 + i % 50);
    Buffer second;
    for (const std::string& body :
         {"GPGGA,1235" + seconds + ".00,4807.0380,N,01131.0000,E,1,08,0.9,545.4,M,46.9,M,,",
          "GPRMC,1235" + seconds + ".00,A,4807.0380,N,01131.0000,E,0.22,084.4,230394,003.1,W,A",
          "GPGSV,2,1,08,01,40,083,46,02,17,308,41,12,07,344,39,14,22,228,4" + std::to_string(i % 10),
          "HCHDM," + std::to_string(i % 360) + ".5,M"}) {
      append(second, protocols::checked_line(body));
    }
    return second;
  });
}

Buffer ubx_stream() {
  return stream_of([](unsigned i) {
    protocols::ubx::NavPvt pvt;
    pvt.time_of_week_ms = i * 100;
    pvt.latitude_deg = 48 + i * 1e-6;
    return protocols::ubx::encode_nav_pvt(pvt);
  });
}

Buffer mip_stream() {
  return stream_of([](unsigned i) {
    protocols::mip::Packet packet;
    packet.set = protocols::mip::kSensorSet;
    packet.reference_time_ns = i * 1'000'000ULL;
    packet.acceleration_m_s2 = packet.rate_rad_s = packet.field_uT = protocols::mip::Triple{0.1 * i, 2, 3};
    return protocols::mip::encode(packet);
  });
}

Buffer pd0_stream() {
  return stream_of([](unsigned i) {
    protocols::pd0::VariableLeader variable;
    variable.ensemble = i;
    return protocols::pd0::encode({protocols::pd0::FixedLeader{}, variable, protocols::pd0::BottomTrack{}});
  });
}

Buffer pd6_stream() {
  return stream_of([](unsigned i) {
    return protocols::pd6::encode(
        protocols::pd6::Velocity{protocols::pd6::kBottomInstrument, {i % 1000 * 1e-3, 0.1, 0.2}, 0.001, true});
  });
}

Buffer water_linked_stream() {
  return stream_of([](unsigned i) {
    protocols::water_linked::Velocity velocity;
    velocity.velocity_m_s[0] = i % 1000 * 1e-3;
    velocity.covariance_m2_s2 = std::array<double, 9>{};
    return protocols::water_linked::encode(velocity);
  });
}

Buffer trax_stream() {
  return stream_of([](unsigned i) {
    protocols::trax::Data data;
    data.heading_deg = i % 360;
    data.pitch_deg = data.roll_deg = 1.5;
    data.field_uT = {20, 1, 40};
    return protocols::trax::encode_data(data);
  });
}

Buffer vectornav_stream() {
  return stream_of([](unsigned i) {
    protocols::vectornav::Reading reading;
    reading.since_startup_ns = i * 5'000'000ULL;
    reading.yaw_pitch_roll_deg = reading.rate_rad_s = reading.acceleration_m_s2 =
        protocols::vectornav::Triple{1, 2, 3};
    return protocols::vectornav::encode_binary(reading);
  });
}

Buffer keller_stream() {
  return stream_of([](unsigned i) {
    return protocols::keller::encode(protocols::keller::Reading{250, 1 + static_cast<float>(i % 1000) * 1e-3F, 0});
  });
}

Buffer paroscientific_stream() {
  return stream_of([](unsigned i) {
    return protocols::paroscientific::encode_line({}, std::to_string(14 + i % 100) + ".71503");
  });
}

Buffer samples_stream() {
  return stream_of([](unsigned i) {
    return R"({"class":"IMU","time":1700000000.)" + std::to_string(100'000'000 + i) +
           R"(,"rate_rad_s":[0.1,-0.2,0.03],"specific_force_m_s2":[0,0,-9.81]})"
           "\n";
  });
}

template <protocols::Scanner S>
std::uint64_t framed_bytes_of(Bytes stream) {
  protocols::StreamParser<S> parser;
  std::uint64_t frames = 0;
  for (; !stream.empty(); stream = stream.subspan(std::min(kReadLength, stream.size()))) {
    parser.feed(stream.first(std::min(kReadLength, stream.size())), [&](const protocols::Frame&) { ++frames; });
  }
  benchmark::DoNotOptimize(frames);
  return parser.counters().framed_bytes;
}

/// CPU time of this thread alone, so that a busy machine does not disturb the comparison.
double cpu_time_s() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

template <protocols::Scanner S>
void framing(benchmark::State& state, const Buffer& stream) {
  double parsing_s = 0, xoring_s = 0;
  for ([[maybe_unused]] auto _ : state) {
    const double began_s = cpu_time_s();
    benchmark::DoNotOptimize(xor_byte_by_byte(stream));
    const double between_s = cpu_time_s();
    const std::uint64_t framed = framed_bytes_of<S>(stream);
    const double ended_s = cpu_time_s();
    if (framed != stream.size()) state.SkipWithError("not every byte was framed");
    xoring_s += between_s - began_s;
    parsing_s += ended_s - between_s;
    state.SetIterationTime(ended_s - between_s);
  }
  const double megabytes = static_cast<double>(stream.size()) * static_cast<double>(state.iterations()) / 1e6;
  state.counters["MB/s"] = megabytes / parsing_s;
  state.counters["xor_MB/s"] = megabytes / xoring_s;
  state.counters["ratio"] = parsing_s / xoring_s;
}

template <protocols::Scanner S>
void add(const char* name, Buffer stream) {
  benchmark::RegisterBenchmark(name, [stream = std::move(stream)](benchmark::State& state) {
    framing<S>(state, stream);
  })->UseManualTime();
}

}  // namespace
}  // namespace navcal::bench

int main(int argc, char** argv) {
  using namespace navcal;
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  bench::add<protocols::tcm2::Scanner>("tcm2", bench::tcm2_stream());
  bench::add<protocols::imu_card::Scanner>("imu_card", bench::imu_card_stream());
  bench::add<protocols::motor_card::Scanner>("motor_card", bench::motor_card_stream());
  bench::add<protocols::oncore::Scanner>("oncore", bench::oncore_stream());
  bench::add<protocols::nmea::Scanner>("nmea", bench::nmea_stream());
  bench::add<protocols::ubx::PortScanner>("ubx", bench::ubx_stream());
  bench::add<protocols::mip::Scanner>("mip", bench::mip_stream());
  bench::add<protocols::pd0::Scanner>("pd0", bench::pd0_stream());
  bench::add<protocols::pd6::Scanner>("pd6", bench::pd6_stream());
  bench::add<protocols::water_linked::Scanner>("water_linked", bench::water_linked_stream());
  bench::add<protocols::trax::Scanner>("trax", bench::trax_stream());
  bench::add<protocols::vectornav::Scanner>("vectornav", bench::vectornav_stream());
  bench::add<protocols::keller::Scanner>("keller", bench::keller_stream());
  bench::add<protocols::paroscientific::Scanner>("paroscientific", bench::paroscientific_stream());
  bench::add<protocols::samples_line::Scanner>("samples", bench::samples_stream());
  benchmark::RunSpecifiedBenchmarks();
}
