// SPDX-License-Identifier: Apache-2.0
#include "validation/reference/thrusters/swim.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "protocols/imu_card.h"
#include "protocols/oncore.h"
#include "protocols/tcm2.h"
#include "protocols/water_linked.h"
#include "tests/validation/reference/thrusters/shipped_plan.h"

namespace navcal::reference::thrusters::testing {
namespace {

struct KeptSwim : Sink {
  std::vector<Transfer> transfers;
  std::vector<Snapshot> truths;
  void transfer(const Transfer& transfer) override { transfers.push_back(transfer); }
  void truth(const Snapshot& snapshot) override { truths.push_back(snapshot); }

  [[nodiscard]] std::vector<std::uint8_t> stream(Port port) const {
    std::vector<std::uint8_t> bytes;
    for (const Transfer& one : transfers) {
      if (one.port == port) bytes.insert(bytes.end(), one.bytes.begin(), one.bytes.end());
    }
    return bytes;
  }
};

CraftUnderTest nominal(const std::string& name) {
  CraftUnderTest craft;
  craft.layout = craft.real = shipped_plan(name);
  return craft;
}

Swim swim_of(const CraftUnderTest& craft, double duration_s, std::uint64_t seed = 1) {
  Rng dice(seed, 77);
  Swim swim;
  swim.start_ns = 1'764'000'000'300'000'000;
  swim.duration_s = duration_s;
  swim.legs = drawn_legs(craft.layout, duration_s, dice);
  swim.start.position_m.z() = 0.28;
  return swim;
}

KeptSwim kept(const Swim& swim, const CraftUnderTest& craft, std::uint64_t seed = 1) {
  KeptSwim sink;
  EXPECT_FALSE(run(swim, craft, seed, sink));
  return sink;
}

template <class Parser>
void expect_frames(const KeptSwim& swim, Port port, double per_second, double duration_s) {
  const auto stream = swim.stream(port);
  std::size_t frames = 0, bytes = 0;
  Parser parser;
  parser.feed(stream, [&](const protocols::Frame& frame) {
    ++frames;
    bytes += frame.bytes.size();
  });
  EXPECT_EQ(bytes, stream.size()) << facts_of(port).name;
  EXPECT_NEAR(static_cast<double>(frames), per_second * duration_s, 2) << facts_of(port).name;
}

class SwimOfLayout : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Shipped, SwimOfLayout, ::testing::ValuesIn(kThrusterLayouts));

TEST_P(SwimOfLayout, EveryByteIsPartOfAFrame) {
  const CraftUnderTest craft = nominal(GetParam());
  const KeptSwim sink = kept(swim_of(craft, 60), craft);
  expect_frames<protocols::tcm2::Parser>(sink, Port::compass, 10, 60);
  expect_frames<protocols::imu_card::Parser>(sink, Port::imu, 20, 60);
  expect_frames<protocols::oncore::Parser>(sink, Port::gps, 1, 60);
  expect_frames<protocols::water_linked::Parser>(sink, Port::doppler, 8, 60);
  const auto lines = sink.stream(Port::actuators);
  EXPECT_NEAR(static_cast<double>(std::count(lines.begin(), lines.end(), '\n')), 597, 1);
}

TEST_P(SwimOfLayout, MissionsByTheDiceAreSwum) {
  const CraftUnderTest craft = nominal(GetParam());
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const KeptSwim sink = kept(swim_of(craft, 100, seed), craft, seed);
    double deepest_m = 0, fastest_m_s = 0, quickest_rad_s = 0;
    for (const Snapshot& s : sink.truths) {
      deepest_m = std::max(deepest_m, s.position_m.z());
      fastest_m_s = std::max(fastest_m_s, s.velocity_m_s.norm());
      quickest_rad_s = std::max(quickest_rad_s, std::abs(s.rate_rad_s.z()));
    }
    EXPECT_GT(deepest_m, 0.9) << seed;
    EXPECT_GT(fastest_m_s, 0.2) << seed;
    EXPECT_GT(quickest_rad_s, 0.2) << seed;
  }
}

TEST_P(SwimOfLayout, TheSameSeedGivesTheSameBytesInOrderOfTime) {
  const CraftUnderTest craft = nominal(GetParam());
  const KeptSwim one = kept(swim_of(craft, 20), craft, 3), again = kept(swim_of(craft, 20), craft, 3);
  ASSERT_EQ(one.transfers.size(), again.transfers.size());
  for (std::size_t i = 0; i < one.transfers.size(); ++i) {
    ASSERT_EQ(one.transfers[i].bytes, again.transfers[i].bytes);
    ASSERT_EQ(one.transfers[i].time_ns, again.transfers[i].time_ns);
    ASSERT_GE(one.transfers[i].time_ns, one.transfers[i > 0 ? i - 1 : 0].time_ns);
  }
  EXPECT_NE(one.stream(Port::imu), kept(swim_of(craft, 20), craft, 4).stream(Port::imu));
}

TEST(Swim, HoldsWhatIsOrdered) {
  CraftUnderTest craft = nominal("bluerov2-heavy");
  craft.noisy = false;
  craft.nature.wave_m = craft.nature.current_m_s = 0;
  Swim swim = swim_of(craft, 40);
  Leg leg;
  leg.heading_rad = 2;
  leg.depth_m = 2;
  swim.legs = {leg};
  const Snapshot end = kept(swim, craft).truths.back();
  EXPECT_NEAR(end.heading_rad(), 2, 0.02);
  EXPECT_NEAR(end.position_m.z(), 2, 0.15);
  EXPECT_LT(std::abs(end.pitch_rad()), 0.03);
  EXPECT_LT(std::abs(end.roll_rad()), 0.03);
}

TEST(Swim, EveryEffectChangesWhatIsRead) {
  const CraftUnderTest craft = nominal("bluerov2");
  Swim swim = swim_of(craft, 40);
  swim.duration_s = 28;
  const auto bytes_of = [](const KeptSwim& sink) {
    std::vector<std::uint8_t> bytes;
    for (const Transfer& one : sink.transfers) bytes.insert(bytes.end(), one.bytes.begin(), one.bytes.end());
    return bytes;
  };
  const auto plain = bytes_of(kept(swim, craft));
  Rng dice(5, 5);
  for (const CraftEffectKind& kind : craft_effects()) {
    if (kind.name == "actuator_reversed") continue;  // some thrusters of those lose the vehicle
    CraftUnderTest other = craft;
    add(drawn(kind, 1, craft.layout, dice), craft.layout, other.differences);
    KeptSwim sink;
    (void)run(swim, other, 1, sink);
    EXPECT_NE(bytes_of(sink), plain) << kind.name;
  }
}

TEST(Swim, ALostVehicleIsReported) {
  CraftUnderTest craft = nominal("bluerov2-heavy");
  craft.real.mass_kg *= 3;
  KeptSwim sink;
  const auto lost = run(swim_of(craft, 60), craft, 1, sink);
  ASSERT_TRUE(lost);
  EXPECT_LT(lost->time_s, 60);
}

TEST(Swim, LegsOutOfOrderAreRefused) {
  const CraftUnderTest craft = nominal("micro-auv");
  Swim swim = swim_of(craft, 60);
  std::swap(swim.legs[1].from_s, swim.legs[2].from_s);
  KeptSwim sink;
  EXPECT_THROW((void)run(swim, craft, 1, sink), std::invalid_argument);
  EXPECT_TRUE(sink.transfers.empty());
}

TEST(CraftEffects, AreAddedByNameAndPlace) {
  const Plan plan = shipped_plan("bluerov2");
  Differences differences;
  add({"thrust_scale", "thruster.2", {{"scale", -0.25}}}, plan, differences);
  add({"damping", "heave", {{"scale", 0.5}}}, plan, differences);
  add({"hard_iron", "", {{"x_uT", 2}}}, plan, differences);
  EXPECT_EQ(differences.craft.rotors[1].scale, -0.25);
  EXPECT_EQ(differences.craft.damping(2), 0.5);
  EXPECT_EQ(differences.instruments.compass.hard_iron_uT.x(), 2);
  for (const CraftEffect& wrong :
       {CraftEffect{"thrust_scale", "thruster.7", {{"scale", 1}}},
        CraftEffect{"thrust_scale", "thruster.0", {{"scale", 1}}}, CraftEffect{"thrust_scale", "", {{"scale", 1}}},
        CraftEffect{"thrust_scale", "thruster.1", {{"size", 1}}}, CraftEffect{"damping", "up", {{"scale", 1}}},
        CraftEffect{"fin_gain", "", {}}})
    EXPECT_THROW(add(wrong, plan, differences), std::invalid_argument) << wrong.name << wrong.of;
}

TEST(CraftEffects, AreDrawnAtTheirTypicalStrength) {
  const Plan plan = shipped_plan("bluerov2-heavy");
  Rng dice(1, 2);
  for (int i = 0; i < 50; ++i) {
    const CraftEffect shift = drawn(*find_craft_effect("gravity_shift"), 2, plan, dice);
    double size2 = 0;
    for (const auto& [key, value] : shift.parameters) size2 += value * value;
    EXPECT_NEAR(std::sqrt(size2), 2 * 0.2 * 0.01, 1e-12);
    EXPECT_GT(drawn(*find_craft_effect("thruster_lag"), 1, plan, dice).parameters.at("tau_s"), 0);
    Differences differences;
    add(drawn(*find_craft_effect("added_mass"), 1, plan, dice), plan, differences);
  }
}

TEST(CraftEffects, APerturbedPlanKeepsItsShape) {
  Rng dice(4, 4);
  for (const char* const name : kThrusterLayouts) {
    const Plan plan = shipped_plan(name), same = perturbed(plan, 0, dice), other = perturbed(plan, 0.05, dice);
    EXPECT_EQ(same.mass_kg, plan.mass_kg);
    EXPECT_NEAR((same.added_mass - plan.added_mass).norm(), 0, 1e-12);
    EXPECT_NE(other.mass_kg, plan.mass_kg);
    EXPECT_NEAR((other.added_mass - other.added_mass.transpose()).norm(), 0, 1e-12);
    EXPECT_NEAR(other.thrusters[0].direction.norm(), 1, 1e-12);
    EXPECT_NEAR(other.thrusters[0].force_N.back() / plan.thrusters[0].force_N.back(), 1, 0.25);
    EXPECT_NEAR(other.buoyancy_N / other.mass_kg, plan.buoyancy_N / plan.mass_kg, 0.06);
  }
}

}  // namespace
}  // namespace navcal::reference::thrusters::testing
