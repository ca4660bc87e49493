// SPDX-License-Identifier: Apache-2.0
#include "calib/suite/gate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace navcal::calib {
namespace {

CompassReading compass(double time_s, double heading_rad) {
  CompassReading reading;
  reading.time_s = time_s;
  reading.heading_rad = heading_rad;
  reading.pitch_rad = reading.roll_rad = 0;
  return reading;
}

RateReading rate(double time_s) {
  RateReading reading;
  reading.time_s = time_s;
  reading.rate_rad_s.z() = std::sin(time_s);
  return reading;
}

std::vector<Reading> through(Gate& gate, const std::vector<Reading>& readings) {
  std::vector<Reading> out;
  const auto drain = [&] {
    while (const auto reading = gate.take()) out.push_back(*reading);
  };
  for (const Reading& reading : readings) {
    gate.put(reading);
    drain();
  }
  gate.flush();
  drain();
  return out;
}

std::uint64_t left_out(const Gate& gate, Stream stream, Rejection reason) {
  return gate.counts().left_out[static_cast<std::size_t>(stream)][static_cast<std::size_t>(reason)];
}

TEST(Gate, GivesReadingsOutInTheOrderOfTheirTimesHoweverLateEachInstrumentIs) {
  std::mt19937 random(1);
  for (int round = 0; round < 20; ++round) {
    std::vector<std::pair<double, Reading>> arrivals;
    std::uniform_real_distribution<double> late(0, 0.4);
    for (int i = 0; i < 200; ++i) {
      arrivals.emplace_back(i * 0.05 + 0.025, rate(i * 0.05));
      if (i % 2 == 0)
        arrivals.emplace_back(i * 0.05 + 0.05 + late(random) * 0.01, compass(i * 0.05 + 0.01, i * 0.01));
      if (i % 20 == 0)
        arrivals.emplace_back(i * 0.05 + late(random), GroundReading{i * 0.05, {1.0 * i, 0}, 1, {}});
    }
    std::stable_sort(arrivals.begin(), arrivals.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<Reading> readings;
    for (const auto& [at, reading] : arrivals) readings.push_back(reading);
    Gate gate;
    const auto out = through(gate, readings);
    EXPECT_EQ(out.size(), readings.size());
    EXPECT_TRUE(std::is_sorted(out.begin(), out.end(),
                               [](const Reading& a, const Reading& b) { return time_of(a) < time_of(b); }));
  }
}

TEST(Gate, CountsEveryReadingOnceAsGivenOutOrLeftOut) {
  std::mt19937 random(2);
  std::vector<Reading> readings;
  for (int i = 0; i < 3000; ++i) {
    CompassReading reading = compass(i * 0.1, std::fmod(i * 0.01, 6.0));
    const auto dice = random() % 40;
    if (dice == 0) reading.time_s = std::nan("");
    if (dice == 1) reading.time_s -= 5;
    if (dice == 2) reading.time_s -= 0.1;
    if (dice == 3) reading.faulty = true;
    readings.emplace_back(reading);
  }
  Gate gate;
  const auto out = through(gate, readings);
  std::uint64_t rejected = 0;
  for (const auto count : gate.counts().left_out[0]) rejected += count;
  EXPECT_EQ(gate.counts().taken[0], readings.size());
  EXPECT_EQ(out.size() + rejected, readings.size());
}

TEST(Gate, AHeadingGoesOnceAround) {
  // A device may round its heading up to the full circle.
  const double turn_rad = 2 * std::acos(-1.0);
  Gate gate;
  const auto out = through(gate, {compass(0, 0), compass(1, turn_rad - 1e-3), compass(2, turn_rad),
                                  compass(3, turn_rad + 0.02), compass(4, -turn_rad - 0.02)});
  EXPECT_EQ(std::ranges::count_if(
                out, [](const Reading& one) { return std::get<CompassReading>(one).heading_rad.has_value(); }),
            3);
  EXPECT_EQ(left_out(gate, Stream::compass, Rejection::absurd), 2U);
}

TEST(Gate, ErrorCodesVoidWhatTheyConcern) {
  std::vector<Reading> readings;
  for (int i = 0; i < 40; ++i) {
    CompassReading reading = compass(i * 0.1, i * 0.01);
    reading.field_body_uT = Eigen::Vector3d(20, i, 40);
    reading.distorted = i % 4 == 0;
    reading.tilt_out_of_range = i % 4 == 1;
    reading.field_out_of_range = i % 4 == 2;
    readings.emplace_back(reading);
  }
  Gate gate;
  const auto out = through(gate, readings);
  ASSERT_EQ(out.size(), readings.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const auto& reading = std::get<CompassReading>(out[i]);
    EXPECT_EQ(reading.heading_rad.has_value(), i % 4 == 0 || i % 4 == 3) << i;
    EXPECT_EQ(reading.roll_rad.has_value(), i % 4 != 1) << i;
    EXPECT_EQ(reading.field_body_uT.has_value(), i % 4 != 2) << i;
  }
  EXPECT_EQ(gate.counts().distorted, 10U);
  EXPECT_EQ(left_out(gate, Stream::compass, Rejection::tilt_out_of_range), 10U);
  EXPECT_EQ(left_out(gate, Stream::compass, Rejection::field_out_of_range), 10U);
}

TEST(Gate, AFieldOver500MicroteslaIsCountedByItsNameAndTheTiltIsUsed) {
  std::vector<Reading> readings;
  for (int i = 0; i < 40; ++i) {
    CompassReading reading = compass(i * 0.1, i * 0.01);
    reading.roll_rad = 0.01 * i;
    reading.field_body_uT = Eigen::Vector3d(20, i, i % 4 == 0 ? 600 : i % 4 == 1 ? -5000 : 499);
    readings.emplace_back(reading);
  }
  Gate gate;
  const auto out = through(gate, readings);
  ASSERT_EQ(out.size(), readings.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const auto& reading = std::get<CompassReading>(out[i]);
    EXPECT_EQ(reading.field_body_uT.has_value(), i % 4 > 1) << i;
    EXPECT_TRUE(reading.roll_rad.has_value()) << i;
  }
  EXPECT_EQ(left_out(gate, Stream::compass, Rejection::field_too_large), 20U);
  EXPECT_EQ(left_out(gate, Stream::compass, Rejection::absurd), 0U);
  EXPECT_EQ(name_of(Rejection::field_too_large), "field_too_large");
}

TEST(Gate, ALiveInstrumentIsNotFrozenByRepeatingItselfForLessThanASecond) {
  std::vector<Reading> readings;
  for (int i = 0; i < 100; ++i) readings.emplace_back(compass(i * 0.1, (i / 8) * 0.1));
  Gate gate;
  EXPECT_EQ(through(gate, readings).size(), 100U);
  EXPECT_EQ(left_out(gate, Stream::compass, Rejection::frozen), 0U);
}

TEST(Gate, AFrozenHeadingIsLeftOutFromItsFirstReadingOn) {
  std::vector<Reading> readings;
  for (int i = 0; i < 100; ++i) readings.emplace_back(compass(i * 0.1, i >= 30 && i < 60 ? 2.0 : i * 0.01));
  Gate gate;
  int headings = 0;
  for (const Reading& reading : through(gate, readings)) {
    const auto& heading = std::get<CompassReading>(reading).heading_rad;
    if (!heading) continue;
    ++headings;
    EXPECT_NE(*heading, 2.0) << time_of(reading);
  }
  EXPECT_EQ(headings, 70);
  EXPECT_EQ(left_out(gate, Stream::compass, Rejection::frozen), 30U);
}

TEST(Gate, MagneticReadingsAboutASwitchOfTheMotorAreLeftOutAndTheirTiltIsNot) {
  GateOptions options;
  options.motor_settle_s = 1;
  options.motor_lead_s = 0.3;
  Gate gate(options);
  std::vector<Reading> readings;
  for (int i = 0; i < 100; ++i) {
    readings.emplace_back(compass(i * 0.1, i * 0.01));
    readings.emplace_back(MotorReading{i * 0.1 + 0.01, i < 50 ? 0.0 : 600.0});
  }
  std::size_t tilts = 0;
  for (const Reading& reading : through(gate, readings)) {
    const auto* one = std::get_if<CompassReading>(&reading);
    if (one == nullptr) continue;
    ++tilts;
    const bool about = one->time_s > 5.01 - 0.3 && one->time_s < 5.01 + 1;
    EXPECT_EQ(one->heading_rad.has_value(), !about) << one->time_s;
  }
  EXPECT_EQ(tilts, 100U);
}

TEST(Gate, AMotorsCurrentPassesWithoutItsSpeed) {
  Gate gate;
  const auto out = through(gate, {MotorReading{1, {}, 2.0}, MotorReading{2, {}, {}}, MotorReading{3, 1e6, 2.0}});
  ASSERT_EQ(out.size(), 1U);
  EXPECT_EQ(std::get<MotorReading>(out.front()).current_A, 2.0);
  EXPECT_FALSE(std::get<MotorReading>(out.front()).rpm);
}

// Limits of what is plausible, from both sides and with both signs; not a number is never.
TEST(Gate, EachQuantityHasItsLimit) {
  struct Limit {
    double most;
    std::function<Reading(double)> with;
    std::function<bool(const Reading&)> has;
    bool is_counted = true;
  };
  constexpr double pi = std::numbers::pi;
  const auto of_compass = [](std::optional<double> CompassReading::*member) {
    return std::pair(
        [member](double value) -> Reading {
          CompassReading one = compass(1, 0.5);
          one.*member = value;
          return one;
        },
        [member](const Reading& one) { return (std::get<CompassReading>(one).*member).has_value(); });
  };
  const auto is_there = [](const Reading&) { return true; };
  const auto [with_heading, has_heading] = of_compass(&CompassReading::heading_rad);
  const auto [with_pitch, has_pitch] = of_compass(&CompassReading::pitch_rad);
  const auto [with_roll, has_roll] = of_compass(&CompassReading::roll_rad);
  const auto with_rate = [](double value) -> Reading {
    RateReading one = rate(1);
    one.rate_rad_s.x() = value;
    return one;
  };
  const auto with_rate_b = [](double value) -> Reading {
    RateReading one = rate(1);
    one.yaw_rate_b_rad_s = value;
    return one;
  };
  const auto with_force = [](double value) -> Reading {
    RateReading one = rate(1);
    one.specific_force_m_s2 = Eigen::Vector3d(0, value, 9);
    return one;
  };
  const auto with_speed = [](double value) -> Reading { return GroundReading{1, {0, 0}, value, {}}; };
  const auto with_place = [](double value) -> Reading { return GroundReading{1, {0, value}, 1, {}}; };
  const auto with_rpm = [](double value) -> Reading { return MotorReading{1, value, 2.0}; };
  const auto with_current = [](double value) -> Reading { return MotorReading{1, 600.0, value}; };
  const auto has_current = [](const Reading& one) { return std::get<MotorReading>(one).current_A.has_value(); };
  const std::vector<Limit> limits{{2 * pi + 0.01, with_heading, has_heading},
                                  {pi / 2 + 0.01, with_pitch, has_pitch},
                                  {pi + 0.01, with_roll, has_roll},
                                  {35, with_rate, is_there},
                                  {35, with_rate_b, is_there},
                                  {200, with_force, is_there},
                                  {50, with_speed, is_there},
                                  {1e6, with_place, is_there},
                                  {1e5, with_rpm, is_there},
                                  {1e3, with_current, has_current, false}};
  for (std::size_t i = 0; i < limits.size(); ++i) {
    const Limit& limit = limits[i];
    const auto passes = [&](double value) {
      Gate gate;
      const auto out = through(gate, {limit.with(value)});
      const bool passed = !out.empty() && limit.has(out.front());
      std::uint64_t counted = 0;
      for (const auto& stream : gate.counts().left_out)
        for (const std::uint64_t count : stream) counted += count;
      EXPECT_EQ(counted, !passed && limit.is_counted ? 1U : 0U) << i << ": " << value;
      return passed;
    };
    for (const double sign : {-1.0, 1.0}) {
      EXPECT_TRUE(passes(sign * (limit.most - 1e-3))) << i;
      EXPECT_FALSE(passes(sign * (limit.most + 1e-3))) << i;
    }
    EXPECT_FALSE(passes(std::nan(""))) << i;
  }
}

// An instrument hangs if it says the same ten times and for 0.9 s; neither alone is enough.
TEST(Gate, AnInstrumentHangsAfterTenReadingsAndNineTenthsOfASecond) {
  const auto frozen = [](double step_s, int same) {
    std::vector<Reading> readings;
    for (int i = 0; i < 60; ++i)
      readings.emplace_back(compass(i * step_s, i >= 20 && i < 20 + same ? 2.0 : 0.01 * i));
    Gate gate;
    (void)through(gate, readings);
    return left_out(gate, Stream::compass, Rejection::frozen);
  };
  EXPECT_EQ(frozen(0.11, 9), 0U) << "nine readings";
  EXPECT_EQ(frozen(0.11, 11), 11U);
  EXPECT_EQ(frozen(0.05, 15), 0U) << "0.7 s";
  EXPECT_EQ(frozen(0.05, 20), 20U);
}

// Saved and restored in the middle of what is frozen, late and switched, it goes on alike.
TEST(Gate, SavedAndRestoredItGoesOnAlike) {
  const auto reading_at = [](int i) -> Reading {
    if (i % 3 == 0) return MotorReading{0.1 * i, i % 60 < 30 ? 0.0 : 600.0, 1.0};
    if (i % 3 == 1) return rate(0.1 * i);
    return compass(0.1 * i - (i % 7 == 0 ? 0.35 : 0.0), i % 90 < 45 ? 2.0 : 0.01 * (i % 200));
  };
  const auto archived = [](Gate& gate) {
    Archive state;
    gate.archive(state);
    return state.bytes();
  };
  for (const int cut : {40, 77, 130, 200}) {
    Gate whole, first, second;
    for (int i = 0; i < 300; ++i) {
      whole.put(reading_at(i));
      Gate& other = i < cut ? first : second;
      other.put(reading_at(i));
      std::optional<Reading> one;
      while ((one = whole.take())) {
        const auto same = other.take();
        ASSERT_TRUE(same && time_of(*same) == time_of(*one) && same->index() == one->index()) << i;
      }
      ASSERT_FALSE(other.take()) << i;
      if (i + 1 != cut) continue;
      const std::string state = archived(first);
      Archive restoring{std::string_view(state)};
      second.archive(restoring);
      ASSERT_TRUE(restoring.ok() && restoring.at_end());
    }
    EXPECT_EQ(archived(second), archived(whole));
  }
}

// A pause is the time between two readings of one instrument that can be used.
TEST(Gate, APauseIsLongerThanOneSecondOrFiveOfFixes) {
  const auto pauses_of = [](double step_s) {
    std::vector<Reading> readings;
    for (int i = 0; i < 4; ++i) {
      const double time_s = i * step_s;
      readings.emplace_back(compass(time_s, 0.1 * i));
      readings.emplace_back(rate(time_s));
      readings.emplace_back(GroundReading{time_s, {1.0 * i, 0}, 1, {}});
      MotorReading motor;
      motor.time_s = time_s;
      motor.rpm = 600 + i;
      motor.current_A = 2 + 0.1 * i;
      readings.emplace_back(motor);
    }
    Gate gate;
    (void)through(gate, readings);
    return gate.counts().gaps;
  };
  const auto at = [](Stream stream) { return static_cast<std::size_t>(stream); };
  const auto short_of_one_s = pauses_of(0.95), above_one_s = pauses_of(1.05), above_five_s = pauses_of(5.1);
  for (const Stream stream : {Stream::compass, Stream::rate, Stream::motor}) {
    EXPECT_EQ(short_of_one_s[at(stream)], 0U) << name_of(stream);
    EXPECT_EQ(above_one_s[at(stream)], 3U) << name_of(stream);
  }
  EXPECT_EQ(pauses_of(4.9)[at(Stream::ground)], 0U);
  EXPECT_EQ(above_five_s[at(Stream::ground)], 3U);
}

// A reading of another instrument that is older than what has been given out would turn time back.
TEST(Gate, WhatComesAfterItsTimeHasPassedIsLeftOut) {
  Gate gate;
  gate.put(rate(10));
  gate.flush();
  ASSERT_TRUE(gate.take());
  ASSERT_FALSE(gate.take());
  gate.put(compass(9, 1.0));
  gate.put(compass(11, 1.1));
  gate.flush();
  const auto next = gate.take();
  ASSERT_TRUE(next);
  EXPECT_EQ(time_of(*next), 11);
  EXPECT_EQ(left_out(gate, Stream::compass, Rejection::reversed), 1U);
}

TEST(Gate, WhenTimeBeginsAnewItGoesOnLater) {
  std::vector<Reading> readings;
  for (int i = 0; i < 100; ++i) readings.emplace_back(rate(1000 + i * 0.1));
  for (int i = 0; i < 200; ++i) readings.emplace_back(rate(5 + i * 0.1));
  Gate gate;
  const auto out = through(gate, readings);
  EXPECT_EQ(gate.counts().restarts, 1U);
  EXPECT_GT(out.size(), 240U);
  double before = -1;
  for (const Reading& reading : out) {
    EXPECT_GT(time_of(reading), before);
    before = time_of(reading);
  }
  EXPECT_GT(before, 1000 + Gate::kRestartGap_s);
}

TEST(Gate, OneWildStampDoesNotSilenceAnInstrumentForEver) {
  std::vector<Reading> readings{rate(0), rate(1e12)};
  for (int i = 1; i < 300; ++i) readings.emplace_back(rate(i * 0.1));
  Gate gate;
  EXPECT_GT(through(gate, readings).size(), 200U);
}

}  // namespace
}  // namespace navcal::calib
