// SPDX-License-Identifier: Apache-2.0
#include "validation/reference/run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>

#include "protocols/imu_card.h"
#include "protocols/motor_card.h"
#include "protocols/oncore.h"
#include "protocols/tcm2.h"
#include "validation/reference/effects.h"

namespace navcal::reference::testing {
namespace {

constexpr std::int64_t kRunStart_ns = 1'764'000'000'300'000'000;

Order steer(double from_s, double heading_deg, double depth_m, double speed_m_s) {
  Order order;
  order.from_s = from_s;
  order.heading_rad = heading_deg * kDegree;
  order.depth_m = depth_m;
  order.speed_m_s = speed_m_s;
  return order;
}

Mission short_mission() {
  Mission mission;
  mission.start_ns = kRunStart_ns;
  mission.duration_s = 60;
  mission.start.position_m = {0, 0, 0.2};
  mission.orders = {steer(5, 0, 0.2, 1.1), steer(20, 90, 1.5, 1.2)};
  Order circle = steer(45, 0, 1.5, 1.0);
  circle.heading_rad.reset();
  circle.rudder_rad = -0.2;
  mission.orders.push_back(circle);
  return mission;
}

struct Kept : Sink {
  std::vector<Transfer> transfers;
  std::vector<Snapshot> truths;
  void transfer(const Transfer& transfer) override { transfers.push_back(transfer); }
  void truth(const Snapshot& snapshot) override { truths.push_back(snapshot); }
};

Kept kept(const Mission& mission, std::uint64_t seed, const VehicleUnderTest& specimen = {}) {
  Kept sink;
  EXPECT_FALSE(run(mission, specimen, seed, sink));
  return sink;
}

std::vector<std::uint8_t> stream_of(const Kept& kept, Port port) {
  std::vector<std::uint8_t> stream;
  for (const Transfer& transfer : kept.transfers) {
    if (transfer.port == port && !transfer.sent)
      stream.insert(stream.end(), transfer.bytes.begin(), transfer.bytes.end());
  }
  return stream;
}

template <class Parser>
std::pair<std::size_t, std::size_t> frames_and_their_bytes(const std::vector<std::uint8_t>& stream) {
  Parser parser;
  std::size_t frames = 0, bytes = 0;
  parser.feed(stream, [&](const protocols::Frame& frame) {
    ++frames;
    bytes += frame.bytes.size();
  });
  return {frames, bytes};
}

TEST(Run, WatersAreFeltAndClocksKept) {
  Mission mission = short_mission();
  mission.anchorage = {-16.8, 179.9999, 0};
  mission.waters.field_uT = {32, 7, -25};
  mission.waters.surface_C = 5;
  VehicleUnderTest specimen;
  specimen.clocks = {0.01, -0.01, 0.01};
  const Kept sink = kept(mission, 1, specimen);
  double size_uT = 0, coldest_C = 100;
  std::size_t words = 0;
  protocols::tcm2::Parser parser;
  parser.feed(stream_of(sink, Port::compass), [&](const protocols::Frame& frame) {
    const auto word = protocols::tcm2::decode_word(frame.bytes);
    ASSERT_TRUE(word);
    ++words;
    size_uT += std::hypot(*word->x, *word->y, *word->z);
    coldest_C = std::min(coldest_C, *word->temperature);
  });
  EXPECT_NEAR(size_uT / static_cast<double>(words), std::hypot(32, 7, 25), 0.05);
  EXPECT_NEAR(coldest_C, 5, 0.7);
  EXPECT_NEAR(static_cast<double>(words), 600 / 1.01, 1.5);
  const auto card = frames_and_their_bytes<protocols::imu_card::Parser>(stream_of(sink, Port::imu));
  EXPECT_NEAR(static_cast<double>(card.first), 1200 / 0.99, 2.5);
}

TEST(Run, ThrustAndDragGrowWithTheWatersDensityAlike) {
  Mission mission = short_mission();
  mission.orders.resize(1);
  const double fresh_m_s = kept(mission, 1).truths.back().velocity_m_s.x();
  mission.waters.density_kg_m3 = 1028;
  EXPECT_NEAR(kept(mission, 1).truths.back().velocity_m_s.x(), fresh_m_s, 0.003);
}

TEST(Run, EveryByteIsPartOfAFrameAndEveryInstrumentKeepsItsPace) {
  const Kept sink = kept(short_mission(), 1);
  const auto check = [&](Port port, auto parsed, double per_second) {
    EXPECT_EQ(parsed.second, stream_of(sink, port).size()) << facts_of(port).name;
    EXPECT_NEAR(static_cast<double>(parsed.first), 60 * per_second, 1.5) << facts_of(port).name;
  };
  check(Port::compass, frames_and_their_bytes<protocols::tcm2::Parser>(stream_of(sink, Port::compass)), 10);
  check(Port::imu, frames_and_their_bytes<protocols::imu_card::Parser>(stream_of(sink, Port::imu)), 20);
  check(Port::gps, frames_and_their_bytes<protocols::oncore::Parser>(stream_of(sink, Port::gps)), 1);
  check(Port::motor, frames_and_their_bytes<protocols::motor_card::Parser>(stream_of(sink, Port::motor)), 10);
}

TEST(Run, HandsOverInOrderOfTimeAsFastAsTheLinesCarry) {
  const Kept sink = kept(short_mission(), 2);
  std::map<Port, std::int64_t> last_ns;
  std::int64_t newest_ns = kRunStart_ns;
  for (const Transfer& transfer : sink.transfers) {
    ASSERT_GE(transfer.time_ns, newest_ns);
    newest_ns = transfer.time_ns;
    if (transfer.sent) continue;
    const std::int64_t wire_ns =
        static_cast<std::int64_t>(transfer.bytes.size()) * 10'000'000'000 / facts_of(transfer.port).baud;
    if (last_ns.contains(transfer.port)) {
      ASSERT_GT(transfer.time_ns - last_ns[transfer.port], wire_ns);
    }
    last_ns[transfer.port] = transfer.time_ns;
  }
}

TEST(Run, TheSameSeedGivesTheSameBytesAndAnotherGivesOthers) {
  const Kept one = kept(short_mission(), 3), again = kept(short_mission(), 3), other = kept(short_mission(), 4);
  ASSERT_EQ(one.transfers.size(), again.transfers.size());
  for (std::size_t i = 0; i < one.transfers.size(); ++i) {
    ASSERT_EQ(one.transfers[i].time_ns, again.transfers[i].time_ns);
    ASSERT_EQ(one.transfers[i].bytes, again.transfers[i].bytes);
  }
  EXPECT_NE(stream_of(one, Port::compass), stream_of(other, Port::compass));
}

TEST(Run, ReachesWhatWasOrderedByWhatTheInstrumentsSay) {
  Mission mission = short_mission();
  mission.duration_s = 44;
  VehicleUnderTest exact;
  exact.noisy = false;
  const Snapshot end = kept(mission, 5, exact).truths.back();
  EXPECT_NEAR(end.heading_rad() / kDegree, 90, 2);
  EXPECT_NEAR(end.position_m.z(), 1.5, 0.15);
  EXPECT_NEAR(end.velocity_m_s.x(), 1.2, 0.03);
  // A depth sensor that says too much leaves it too high: the helmsman believes it.
  add({"depth_scale", {{"scale", 0.2}}}, exact.deviations);
  EXPECT_NEAR(kept(mission, 5, exact).truths.back().position_m.z(), 1.25, 0.15);
}

TEST(Run, OrdersAreWrittenOnceAndAsTheCardTakesThem) {
  const Kept sink = kept(short_mission(), 6);
  std::vector<std::uint8_t> last;
  std::size_t written = 0;
  for (const Transfer& transfer : sink.transfers) {
    if (!transfer.sent) continue;
    ++written;
    EXPECT_NE(transfer.bytes, last);
    last = transfer.bytes;
    const auto command = protocols::motor_card::decode_command(last);
    ASSERT_TRUE(command);
    for (const double fin_deg : command->fins_deg)
      EXPECT_LE(std::abs(fin_deg), protocols::motor_card::kFinLimit_deg);
  }
  EXPECT_GT(written, 100U);
  EXPECT_LE(written, 600U);
}

TEST(Run, EveryEffectChangesWhatIsRead) {
  Mission mission = short_mission();
  mission.duration_s = 22;
  mission.orders = {steer(0, 0, 0.2, 1.1), steer(12, 90, 1.5, 1.4)};
  const auto bytes_of = [](const Kept& kept) {
    std::vector<std::uint8_t> bytes;
    for (const Port port : {Port::compass, Port::imu, Port::gps, Port::motor}) {
      const auto stream = stream_of(kept, port);
      bytes.insert(bytes.end(), stream.begin(), stream.end());
    }
    return bytes;
  };
  const auto nominal = bytes_of(kept(mission, 7));
  Rng dice(7, 99);
  for (const auto kinds : {library_effects(), foreign_effects()}) {
    for (const EffectKind& kind : kinds) {
      VehicleUnderTest specimen;
      add(drawn(kind, 1, dice), specimen.deviations);
      EXPECT_NE(bytes_of(kept(mission, 7, specimen)), nominal) << kind.name;
    }
  }
}

TEST(Run, AVehicleWithoutBoundsIsReportedLost) {
  VehicleUnderTest specimen;
  specimen.deviations.vehicle.yaw_damping_per_s = -1000;
  Kept sink;
  const auto lost = run(short_mission(), specimen, 1, sink);
  ASSERT_TRUE(lost);
  EXPECT_LT(lost->time_s, 60);
  EXPECT_TRUE(lost->last.position_m.allFinite());
}

TEST(Run, OrdersThatCannotBeAreRefused) {
  Kept sink;
  Mission mission = short_mission();
  std::swap(mission.orders[0], mission.orders[1]);
  EXPECT_THROW((void)run(mission, {}, 1, sink), std::invalid_argument);
  mission = short_mission();
  mission.orders[1].depth_m = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)run(mission, {}, 1, sink), std::invalid_argument);
  mission = short_mission();
  mission.duration_s = -1;
  EXPECT_THROW((void)run(mission, {}, 1, sink), std::invalid_argument);
  EXPECT_TRUE(sink.transfers.empty());
}

TEST(Run, WithoutOrdersNothingTurns) {
  Mission mission;
  mission.start_ns = kRunStart_ns;
  mission.duration_s = 3;
  const Kept sink = kept(mission, 8);
  EXPECT_LT(sink.truths.back().position_m.norm(), 1e-12);
  for (const Transfer& transfer : sink.transfers) EXPECT_FALSE(transfer.sent);
}

}  // namespace
}  // namespace navcal::reference::testing
