// SPDX-License-Identifier: Apache-2.0
// Captures of Doppler logs by others, through the pipeline.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>

#include "analysis/import/import_log.h"
#include "base/angles.h"
#include "protocols/pd0.h"
#include "sim/rotation.h"
#include "tests/analysis/one_port.h"
#include "tests/support/temporary_folder.h"

namespace navcal::analysis {
namespace {

using instruments::CompassSample;
using instruments::DvlSample;
using protocols::Protocol;
using sim::operator*;
using sim::testing::kStart_ns;
namespace pd0 = protocols::pd0;

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

TEST(SavedDopplerLog, ItsOwnClockGivesTheTimes) {
  const auto file =
      std::filesystem::path(NAVCAL_SOURCE_DIR).parent_path() / "shared" / "devices" / "pd0" / "RDI_withBT.000";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no captures of Doppler logs here";
  const navcal::test::TemporaryFolder folder;
  const ImportReport report = import_bytes(file, Protocol::pd0, 0, folder / "a.mcap", [](double) {});
  // 1721 ensembles, 1.5 s apart, of which the file's last one is cut.
  EXPECT_NEAR(static_cast<double>(report.duration_ns) * 1e-9, 1720 * 1.5, 5);
  ASSERT_EQ(report.remarks.size(), 1U);
  EXPECT_EQ(report.remarks.front(), "times are those of the device's own clock");
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
    ASSERT_TRUE(sample.bottom_velocity_m_s);
    const auto& v = *sample.bottom_velocity_m_s;
    if (std::hypot(v[0], v[1]) > 1) {
      ++fast;
      EXPECT_GT(v[0], 0.9 * std::hypot(v[0], v[1]));
    }
    // Two heads take turns. The upper one's leader comes with the bottom track of the lower one.
    const auto ensemble = pd0::decode(frame.bytes);
    ASSERT_EQ(sample.altitude_m.has_value(), !ensemble.fixed->looks_up());
    if (ensemble.variable->pitch_deg > -20 || ensemble.fixed->looks_up()) return;
    ++tilted;
    double least = 1e9, most = 0;
    for (const auto& range_m : ensemble.bottom->range_m) {
      least = std::min(least, range_m.value());
      most = std::max(most, range_m.value());
    }
    EXPECT_GT(most / least, 1.2) << "with the nose 20 degrees down the beams differ";
    EXPECT_GT(*sample.altitude_m, least);
    EXPECT_LT(*sample.altitude_m, most);
  });
  EXPECT_GT(fast, 20U);
  EXPECT_GT(tilted, 1U);
}

}  // namespace
}  // namespace navcal::analysis
