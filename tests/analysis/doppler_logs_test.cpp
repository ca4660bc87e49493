// SPDX-License-Identifier: Apache-2.0
// Doppler logs and pressure gauges from the simulated vehicle, and from captures by others, to their samples.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>

#include "base/angles.h"
#include "config/load.h"
#include "instruments/start_up.h"
#include "pipeline/pipeline.h"
#include "protocols/pd0.h"
#include "protocols/water_linked.h"
#include "sim/instruments/doppler_devices.h"
#include "sim/instruments/emulators.h"
#include "sim/instruments/pressure_gauges.h"
#include "sim/rotation.h"
#include "tests/sim/drive.h"

namespace navcal::analysis {
namespace {

using instruments::CompassSample;
using instruments::DepthSample;
using instruments::DvlSample;
using protocols::Protocol;
using sim::operator*;
using sim::testing::kSecond_ns;
using sim::testing::kStart_ns;
namespace pd0 = protocols::pd0;

/// One port without anything else.
class OnePort : private pipeline::Sink {
 public:
  explicit OnePort(Protocol protocol) : pipeline_(settings_of(protocol)) {}

  void bytes(std::int64_t now_ns, protocols::Bytes bytes) { pipeline_.bytes(0, now_ns, bytes, *this); }
  void run(sim::Device& device, int seconds) {
    device.power_on(kStart_ns);
    for (const sim::Emission& emission : sim::testing::run_to(device, kStart_ns + seconds * kSecond_ns)) {
      const auto wire_ns = static_cast<std::int64_t>(emission.bytes.size()) * 10 * kSecond_ns / device.baud();
      bytes(emission.start_ns + wire_ns, emission.bytes);
    }
  }
  [[nodiscard]] pipeline::PortStatistics statistics() const { return pipeline_.statistics(0); }
  template <class T>
  [[nodiscard]] std::vector<T> all() const {
    std::vector<T> found;
    for (const auto& sample : samples) {
      if (const auto* value = std::get_if<T>(&sample.value)) found.push_back(*value);
    }
    return found;
  }

  std::vector<instruments::Sample> samples;

 private:
  static config::Settings settings_of(Protocol protocol) {
    config::Settings settings;
    settings.ports.push_back(config::default_port("log", protocol, config::default_baud(protocol)));
    return settings;
  }
  void on_sample(const instruments::Sample& sample) override { samples.push_back(sample); }

  pipeline::Pipeline pipeline_;
};

/// Under way in a current, tilted and turning nowhere.
struct Tilted : sim::testing::Still {
  Tilted() {
    state.position_m = {0, 0, 5};
    state.euler_rad = {0.12, -0.2, 2.2};
    state.velocity_body_m_s = {1.4, 0.1, -0.06};
    state.current_m_s = {0.2, -0.3};
  }
};

sim::Vector3 mean_of(const std::vector<sim::Vector3>& all) {
  sim::Vector3 mean{};
  for (const auto& one : all) {
    for (std::size_t i = 0; i < 3; ++i) mean[i] += one[i] / static_cast<double>(all.size());
  }
  return mean;
}

std::vector<sim::Vector3> bottom_velocities(const OnePort& port) {
  std::vector<sim::Vector3> all;
  for (const DvlSample& sample : port.all<DvlSample>()) {
    if (sample.bottom_velocity_m_s) all.push_back(*sample.bottom_velocity_m_s);
  }
  return all;
}

/// Spread of one component, m/s.
double spread(const std::vector<sim::Vector3>& all, std::size_t component) {
  const double mean = mean_of(all)[component];
  double square = 0;
  for (const auto& one : all) square += (one[component] - mean) * (one[component] - mean);
  return std::sqrt(square / static_cast<double>(all.size()));
}

void expect_close(const sim::Vector3& found, const sim::Vector3& expected) {
  // Scale error of 0.2 %, noise of the mean of some hundred pings, and steps of the attitude.
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(found[i], expected[i], 0.006) << i;
}

TEST(DopplerLogs, Pd0IsUnderstoodInAllItsAxes) {
  const Tilted motion;
  for (const auto axes : {pd0::Axes::beam, pd0::Axes::instrument, pd0::Axes::ship, pd0::Axes::earth}) {
    for (const bool convex : {true, false}) {
      for (const bool uses_tilts : {true, false}) {
        sim::Pd0Doppler::Options options;
        options.axes = axes;
        options.convex = convex;
        options.uses_tilts = uses_tilts;
        sim::Pd0Doppler log(options, motion);
        OnePort port(Protocol::pd0);
        port.run(log, 60);
        const auto velocities = bottom_velocities(port);
        ASSERT_EQ(velocities.size(), 300U);
        const sim::Vector3 body = sim::velocity_over_bottom_m_s(motion.state);
        if (axes == pd0::Axes::earth) {
          expect_close(mean_of(velocities),
                       sim::R_world_from_body({0.12, -0.2, magnetic_heading_rad(motion.state)}) * body);
        } else {
          expect_close(mean_of(velocities), body);
        }
        const auto last = port.all<DvlSample>().back();
        EXPECT_NEAR(last.altitude_m.value(), 15, 0.1);
        if (axes != pd0::Axes::earth) {
          EXPECT_NEAR(last.bottom_velocity_std_m_s.value() / spread(velocities, 0), 1, 0.6)
              << "stated and true error";
        }
        EXPECT_EQ(port.statistics().out_of_range, 0U);
        EXPECT_EQ(port.statistics().bytes.skipped_bytes, 0U);
      }
    }
  }
}

TEST(DopplerLogs, Pd0GivesAttitudeAndPressure) {
  const Tilted motion;
  sim::Pd0Doppler log({}, motion);
  OnePort port(Protocol::pd0);
  port.run(log, 5);
  const CompassSample compass = port.all<CompassSample>().back();
  EXPECT_NEAR(compass.heading_rad.value(), sim::magnetic_heading_rad(motion.state), 1e-4);
  EXPECT_NEAR(compass.pitch_rad.value(), -0.2, 1e-4);
  EXPECT_NEAR(compass.roll_rad.value(), 0.12, 1e-4);
  EXPECT_NEAR(port.all<DepthSample>().back().pressure_Pa.value(), sim::absolute_pressure_Pa(motion.state), 10);
}

TEST(DopplerLogs, Pd6AndWaterLinkedGiveTheSameVelocity) {
  const Tilted motion;
  sim::Pd6Doppler pd6({}, motion);
  sim::WaterLinkedDoppler water_linked({}, motion);
  for (const auto& [log, protocol] :
       {std::pair<sim::Device*, Protocol>{&pd6, Protocol::pd6}, {&water_linked, Protocol::water_linked}}) {
    OnePort port(protocol);
    port.run(*log, 60);
    const auto velocities = bottom_velocities(port);
    ASSERT_EQ(velocities.size(), 300U);
    expect_close(mean_of(velocities), sim::velocity_over_bottom_m_s(motion.state));
    const double std_m_s = port.all<DvlSample>().back().bottom_velocity_std_m_s.value();
    EXPECT_NEAR(std_m_s / spread(velocities, 0), 1, 0.6);
    EXPECT_EQ(port.statistics().out_of_range, 0U);
    EXPECT_EQ(port.statistics().bytes.skipped_bytes, 0U);
  }
}

TEST(DopplerLogs, BottomLockComesAndGoes) {
  struct Diving : sim::testing::Still {
    [[nodiscard]] sim::State at(std::int64_t t_ns) const override {
      sim::State now = state;
      now.velocity_body_m_s = {1, 0, 1};
      now.position_m[2] = static_cast<double>(t_ns - kStart_ns) * 1e-9;
      return now;
    }
  };
  const Diving motion;
  for (const Protocol protocol : {Protocol::pd0, Protocol::pd6, Protocol::water_linked}) {
    sim::EmulatorOptions options;
    options.floor.depth_m = 60;
    const auto log = sim::make_emulator(protocol, options, motion);
    OnePort port(protocol);
    port.run(*log, 40);
    const auto samples = port.all<DvlSample>();
    EXPECT_FALSE(samples.front().bottom_velocity_m_s);
    EXPECT_FALSE(samples.front().altitude_m);
    ASSERT_TRUE(samples.back().bottom_velocity_m_s);
    EXPECT_NEAR(samples.back().altitude_m.value(), 20, 0.3);
    EXPECT_NEAR((*samples.back().bottom_velocity_m_s)[2], 1, 0.03) << "down is positive";
  }
}

TEST(DopplerLogs, WaterLinkedStatesItsAge) {
  const Tilted motion;
  for (const double latency_s : {0.02, 0.3}) {
    sim::DopplerLog::Options options;
    options.latency_s = latency_s;
    sim::WaterLinkedDoppler log(options, motion);
    OnePort port(Protocol::water_linked);
    port.run(log, 3);
    ASSERT_FALSE(port.samples.empty());
    for (std::size_t i = 0; i < port.samples.size(); ++i) {
      const std::int64_t measured_ns =
          kStart_ns + static_cast<std::int64_t>(i + 1) * kSecond_ns / 5 - std::llround(latency_s * 1e9);
      // The whole ping was one read: the first line of it lies in the middle of the others.
      EXPECT_NEAR(static_cast<double>(port.samples[i].stamp.validity_ns - measured_ns), 0, 20e6);
    }
  }
}

/// The gauge, its dialogue and a pipeline.
std::vector<DepthSample> gauge_samples(Protocol protocol, sim::Device& gauge, int seconds) {
  OnePort port(protocol);
  const auto settings = config::default_port("gauge", protocol, config::default_baud(protocol));
  const auto start_up = instruments::make_start_up(settings);
  struct Frames : pipeline::Sink {
    void on_sample(const instruments::Sample& sample) override { samples.push_back(sample); }
    void on_frame(std::uint16_t, const protocols::Frame& frame, std::int64_t now_ns) override {
      dialogue->on_frame(frame, now_ns);
    }
    instruments::StartUp* dialogue = nullptr;
    std::vector<instruments::Sample> samples;
  } sink;
  sink.dialogue = start_up.get();
  config::Settings all;
  all.ports.push_back(settings);
  pipeline::Pipeline stream(all);
  gauge.power_on(kStart_ns);
  start_up->begin(kStart_ns);
  for (std::int64_t now_ns = kStart_ns; now_ns < kStart_ns + seconds * kSecond_ns; now_ns += kSecond_ns / 1000) {
    std::vector<sim::Emission> emissions;
    gauge.advance(now_ns, emissions);
    for (const auto& emission : emissions) stream.bytes(0, now_ns + 1, emission.bytes, sink);
    while (const auto request = start_up->next(now_ns)) gauge.on_bytes(now_ns, *request);
  }
  EXPECT_EQ(stream.statistics(0).out_of_range, 0U);
  std::vector<DepthSample> samples;
  for (const auto& sample : sink.samples) samples.push_back(std::get<DepthSample>(sample.value));
  return samples;
}

TEST(PressureGauges, GivePascalWhateverTheirUnit) {
  const Tilted motion;
  for (int unit = 1; unit <= 8; ++unit) {
    sim::ParoscientificEmulator::Options options;
    options.unit = unit;
    sim::ParoscientificEmulator gauge(options, motion);
    const auto samples = gauge_samples(Protocol::paroscientific, gauge, 10);
    EXPECT_GE(samples.size(), 13U);
    for (const DepthSample& sample : samples)
      EXPECT_NEAR(sample.pressure_Pa.value(), sim::absolute_pressure_Pa(motion.state), 120) << unit;
  }
}

TEST(PressureGauges, KellerIsPolledWithAndWithoutEchoes) {
  const Tilted motion;
  for (const bool echoes : {false, true}) {
    sim::KellerEmulator::Options options;
    options.echoes = echoes;
    sim::KellerEmulator gauge(options, motion);
    const auto samples = gauge_samples(Protocol::keller, gauge, 10);
    EXPECT_NEAR(static_cast<double>(samples.size()), 100, 2);
    for (const DepthSample& sample : samples)
      EXPECT_NEAR(sample.pressure_Pa.value(), sim::absolute_pressure_Pa(motion.state), 120);
  }
}

// Captures by others.

std::vector<std::uint8_t> capture(const std::string& name) {
  std::ifstream file(std::filesystem::path(NAVCAL_SOURCE_DIR).parent_path() / "shared" / "devices" / "pd0" / name,
                     std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

struct CaptureOfOthers {
  const char* name;
  std::size_t ensembles;
};
constexpr CaptureOfOthers kCaptures[] = {{"RDI_withBT.000", 1721}, {"adcp_auv_51.pd0", 51}, {"NE051400.PD0", 193}};

class DopplerCaptures : public testing::TestWithParam<CaptureOfOthers> {
 protected:
  void SetUp() override {
    stream = capture(GetParam().name);
    if (stream.empty()) GTEST_SKIP() << "no captures of Doppler logs here";
  }
  std::vector<std::uint8_t> stream;
};

TEST_P(DopplerCaptures, EveryByteIsAccountedForAndValuesArePlausible) {
  OnePort port(Protocol::pd0);
  for (std::size_t i = 0; i < stream.size(); i += 256)
    port.bytes(kStart_ns + static_cast<std::int64_t>(i) * 100'000,
               protocols::Bytes(stream).subspan(i, std::min<std::size_t>(256, stream.size() - i)));
  const auto statistics = port.statistics();
  EXPECT_EQ(statistics.bytes.frames, GetParam().ensembles);
  EXPECT_EQ(statistics.bytes.bytes,
            statistics.bytes.framed_bytes + statistics.bytes.skipped_bytes + statistics.held_bytes);
  EXPECT_EQ(statistics.out_of_range, 0U);
  EXPECT_EQ(port.all<DvlSample>().size(), GetParam().ensembles);
  std::size_t with_lock = 0;
  for (const DvlSample& sample : port.all<DvlSample>()) {
    if (!sample.bottom_velocity_m_s) continue;
    ++with_lock;
    for (const double one : *sample.bottom_velocity_m_s) EXPECT_LT(std::abs(one), 5);
    if (sample.bottom_velocity_std_m_s) {
      EXPECT_GT(*sample.bottom_velocity_std_m_s, 0);
      EXPECT_LT(*sample.bottom_velocity_std_m_s, 0.5);
    }
  }
  EXPECT_GT(with_lock, 40U);
}

TEST_P(DopplerCaptures, DamageNeverBreaksIt) {
  const std::size_t part = std::min<std::size_t>(stream.size(), 2500);
  for (std::size_t cut = 0; cut < part; cut += 7) {
    OnePort port(Protocol::pd0);
    port.bytes(kStart_ns, protocols::Bytes(stream).first(cut));
    EXPECT_EQ(port.statistics().bytes.framed_bytes + port.statistics().bytes.skipped_bytes +
                  port.statistics().held_bytes,
              cut);
  }
  std::mt19937_64 random(1);
  for (int run = 0; run < 20; ++run) {
    auto damaged = stream;
    damaged.resize(std::min<std::size_t>(damaged.size(), 60000));
    for (int flip = 0; flip < 60; ++flip)
      damaged[random() % damaged.size()] ^= static_cast<std::uint8_t>(1U << random() % 8);
    OnePort port(Protocol::pd0);
    port.bytes(kStart_ns, damaged);
    EXPECT_LT(port.statistics().bytes.frames, GetParam().ensembles);
  }
}

INSTANTIATE_TEST_SUITE_P(Pd0, DopplerCaptures, testing::ValuesIn(kCaptures),
                         [](const auto& one) { return std::string(one.param.name).substr(0, 7); });

/// Way down by the log's vertical velocity, and by the depth of the leader, over the ensembles with bottom lock.
struct WayDown {
  double by_velocity_m = 0, by_depth_m = 0;
};

WayDown way_down(const std::vector<std::uint8_t>& stream) {
  WayDown way;
  struct Instant {
    double time_s, down_m_s, depth_m;
  };
  std::optional<Instant> before;
  pd0::Parser parser;
  parser.feed(stream, [&](const protocols::Frame& frame) {
    OnePort port(Protocol::pd0);
    port.bytes(kStart_ns, frame.bytes);
    const auto leader = pd0::decode(frame.bytes).variable.value();
    const DvlSample sample = port.all<DvlSample>().at(0);
    std::optional<Instant> now;
    if (sample.bottom_velocity_m_s) {
      const double time_s = 3600.0 * leader.time.hour + 60.0 * leader.time.minute + leader.time.second;
      const sim::Vector3 world = sample.frame == instruments::VelocityFrame::earth
                                     ? *sample.bottom_velocity_m_s
                                     : sim::R_world_from_body({leader.roll_deg * base::kRadiansPerDegree,
                                                               leader.pitch_deg * base::kRadiansPerDegree, 0}) *
                                           *sample.bottom_velocity_m_s;
      now = Instant{time_s + leader.time.nanosecond * 1e-9, world[2], leader.depth_m};
      if (before) {
        way.by_velocity_m += (now->down_m_s + before->down_m_s) / 2 * (now->time_s - before->time_s);
        way.by_depth_m += now->depth_m - before->depth_m;
      }
    }
    before = now;
  });
  return way;
}

TEST(CapturedMotion, VerticalVelocitiesAgreeWithTheDepthOfVehiclesUnderWay) {
  const auto glider = capture("NE051400.PD0"), vehicle = capture("adcp_auv_51.pd0");
  if (glider.empty() || vehicle.empty()) GTEST_SKIP() << "no captures of Doppler logs here";
  const WayDown of_glider = way_down(glider);
  EXPECT_GT(of_glider.by_depth_m, 60);
  EXPECT_NEAR(of_glider.by_velocity_m, of_glider.by_depth_m, 0.01 * of_glider.by_depth_m);
  // Pings ten seconds apart while it dives.
  const WayDown of_vehicle = way_down(vehicle);
  EXPECT_GT(of_vehicle.by_depth_m, 8);
  EXPECT_NEAR(of_vehicle.by_velocity_m, of_vehicle.by_depth_m, 0.15 * of_vehicle.by_depth_m);
}

TEST(CapturedMotion, AVehicleUnderWayMovesForwardAndItsBeamsAgreeOnTheAltitude) {
  const auto stream = capture("adcp_auv_51.pd0");
  if (stream.empty()) GTEST_SKIP() << "no captures of Doppler logs here";
  std::size_t fast = 0, tilted = 0;
  pd0::Parser parser;
  parser.feed(stream, [&](const protocols::Frame& frame) {
    OnePort port(Protocol::pd0);
    port.bytes(kStart_ns, frame.bytes);
    EXPECT_TRUE(port.all<CompassSample>().empty()) << "its attitude was set by the vehicle";
    const DvlSample sample = port.all<DvlSample>().at(0);
    ASSERT_TRUE(sample.bottom_velocity_m_s && sample.altitude_m);
    const auto& v = *sample.bottom_velocity_m_s;
    if (std::hypot(v[0], v[1]) > 1) {
      ++fast;
      EXPECT_GT(v[0], 0.9 * std::hypot(v[0], v[1]));
    }
    const auto ensemble = pd0::decode(frame.bytes);
    if (ensemble.variable->pitch_deg > -20) return;
    ++tilted;
    double least = 1e9, most = 0;
    for (const auto& range_m : ensemble.bottom->range_m) {
      least = std::min(least, range_m.value());
      most = std::max(most, range_m.value());
    }
    EXPECT_GT(most / least, 1.3) << "with the nose 20 degrees down the beams differ";
    EXPECT_GT(*sample.altitude_m, least);
    EXPECT_LT(*sample.altitude_m, most);
  });
  EXPECT_GT(fast, 20U);
  EXPECT_GT(tilted, 1U);
}

}  // namespace
}  // namespace navcal::analysis
