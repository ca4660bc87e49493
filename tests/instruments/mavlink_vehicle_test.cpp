// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <limits>

#include "config/load.h"
#include "instruments/autopilot_compass.h"
#include "protocols/mavlink.h"
#include "protocols/mavlink_signer.h"
#include "tests/instruments/collector.h"
#include "tests/instruments/dialogue.h"

namespace navcal::instruments {
namespace {

namespace mavlink = protocols::mavlink;
using Verdict = Instrument::Verdict;

/// A payload, number by number.
struct Fields {
  std::vector<std::uint8_t> bytes;
  template <class T>
  Fields& put(T value) {
    bytes.resize(bytes.size() + sizeof value);
    protocols::put_le(bytes.data() + bytes.size() - sizeof value, value);
    return *this;
  }
};

Fields parameter_value(const std::string& name, float value) {
  Fields fields = Fields{}.put(value).put(std::uint32_t{0});
  for (std::size_t i = 0; i < 16; ++i) fields.put(i < name.size() ? name[i] : '\0');
  return fields.put(std::uint8_t{9});
}

config::PortSettings port() { return config::default_port("rov", protocols::Protocol::mavlink, 4'000'000); }

struct Vehicle : testing::Test {
  config::PortSettings settings = port();
  std::unique_ptr<Instrument> instrument = make_instrument(settings);
  Collector collector{*instrument};

  Verdict send(std::uint32_t id, const Fields& fields, std::uint8_t system = 1, std::uint8_t component = 1) {
    collector.feed<mavlink::Parser>(mavlink::encode(id, {system, component, 0}, fields.bytes));
    return collector.verdicts.back();
  }
  Verdict heartbeat(std::uint8_t system = 1, std::uint8_t component = 1, std::uint8_t autopilot = 3) {
    return send(0, Fields{}.put(std::uint32_t{0}).put(std::uint8_t{12}).put(autopilot), system, component);
  }
  Verdict raw_imu(std::uint64_t time_us, std::int16_t field = 200) {
    return send(27, Fields{}.put(time_us).put(std::uint64_t{1}).put(std::uint32_t{0}).put(field));
  }
  /// A calibration that changes nothing but adds `offset_mG` to the first axis.
  void calibration(float offset_mG = 0) {
    for (const std::string& name : AutopilotCompass::names(0))
      parameter(name, name.find("DIA") != std::string::npos ? 1.0F : name == "COMPASS_OFS_X" ? offset_mG : 0.0F);
  }
  Verdict parameter(const std::string& name, float value) { return send(22, parameter_value(name, value)); }
  Verdict pressure(std::uint32_t id, std::uint32_t time_ms = 1000, std::uint8_t system = 1,
                   std::uint8_t component = 1) {
    return send(id, Fields{}.put(time_ms).put(1350.0F).put(0.0F).put(std::int16_t{1250}), system, component);
  }
  Verdict attitude(std::uint32_t time_ms) {
    return send(30, Fields{}.put(time_ms).put(0.125F).put(-0.25F).put(1.5F));
  }
  Verdict servo(std::uint32_t time_us) {
    return send(36, Fields{}.put(time_us).put(std::uint16_t{1500}).put(std::uint16_t{65535}));
  }
  std::optional<std::int64_t> newest_ns() const { return collector.measurements.back().device_time_ns; }
};

TEST_F(Vehicle, OnlyTheAutopilotOfTheVehicleIsRead) {
  EXPECT_EQ(pressure(137), Verdict::ignored) << "no heartbeat yet";
  EXPECT_EQ(heartbeat(255, 190, 8), Verdict::ignored);
  EXPECT_EQ(heartbeat(1, 100, 8), Verdict::ignored) << "a camera";
  EXPECT_EQ(heartbeat(), Verdict::ignored);
  EXPECT_EQ(pressure(137), Verdict::used);
  EXPECT_EQ(pressure(137, 1000, 9), Verdict::foreign);
  EXPECT_EQ(pressure(137, 1000, 1, 100), Verdict::ignored);
  for (int i = 0; i < 5; ++i) heartbeat(9);
  heartbeat();
  for (int i = 0; i < 10; ++i) EXPECT_EQ(heartbeat(9), Verdict::foreign);
  EXPECT_EQ(pressure(137), Verdict::used) << "two vehicles: the first stays";
  heartbeat(9);
  EXPECT_EQ(pressure(137, 1000, 9), Verdict::used) << "it has another number now";
}

TEST_F(Vehicle, TheConfiguredSensorsAreTaken) {
  heartbeat();
  EXPECT_EQ(pressure(29), Verdict::ignored) << "inside the hull";
  EXPECT_EQ(pressure(137), Verdict::used);
  settings.pressure_sensor = 1;
  const auto other = make_instrument(settings);
  Collector of_other{*other};
  of_other.feed<mavlink::Parser>(mavlink::encode(0, {1, 1, 0}, Fields{}.put(std::uint64_t{3} << 40).bytes));
  of_other.feed<mavlink::Parser>(mavlink::encode(
      29, {1, 1, 0}, Fields{}.put(std::uint32_t{1}).put(1013.25F).put(0.0F).put(std::int16_t{1}).bytes));
  ASSERT_EQ(of_other.all<DepthSample>().size(), 1U);
  EXPECT_NEAR(*of_other.all<DepthSample>()[0].pressure_Pa, 101'325, 0.01);
}

TEST_F(Vehicle, TheAutopilotsCalibrationIsUndone) {
  heartbeat();
  raw_imu(1'000'000, 190);
  EXPECT_TRUE(collector.all<CompassSample>().empty()) << "its parameters are waited for";
  calibration(-50);
  raw_imu(1'100'000, 200);
  calibration(25);
  raw_imu(1'200'000, 275);
  const auto compass = collector.all<CompassSample>();
  ASSERT_EQ(compass.size(), 2U);
  EXPECT_NEAR((*compass[0].field_body_uT)[0], 25, 1e-6);
  EXPECT_NEAR((*compass[1].field_body_uT)[0], 25, 1e-6) << "calibrated anew: the measured field is the same";
  EXPECT_FALSE(instrument->has_corrected_fields());
}

TEST_F(Vehicle, WithoutItsParametersTheFieldStaysAsSent) {
  heartbeat();
  for (int i = 0; i < 10; ++i)
    raw_imu(1'000'000 + 1'000'000 * static_cast<std::uint64_t>(i), static_cast<std::int16_t>(200 + i));
  calibration(-50);
  raw_imu(11'500'000, 300);
  const auto compass = collector.all<CompassSample>();
  ASSERT_EQ(compass.size(), 6U) << "of the first five seconds none";
  EXPECT_NEAR((*compass[0].field_body_uT)[0], 20.5, 1e-6);
  EXPECT_NEAR((*compass.back().field_body_uT)[0], 30, 1e-6) << "a change of sort would be a step of the field";
  EXPECT_TRUE(instrument->has_corrected_fields());
}

TEST_F(Vehicle, TheFieldHasTheTiltOfTheAttitudeWhileThatIsNew) {
  heartbeat();
  calibration();
  attitude(1000);
  raw_imu(1'050'000, 200);
  raw_imu(1'200'000, 210);
  const auto compass = collector.all<CompassSample>();
  ASSERT_EQ(compass.size(), 3U);
  EXPECT_EQ(compass[0].heading_rad, 1.5) << "the autopilot's own";
  EXPECT_TRUE(compass[0].heading_is_true);
  EXPECT_NEAR(compass[0].heading_std_rad.value_or(0), 10 * 3.14159265358979 / 180, 1e-9);
  EXPECT_FALSE(compass[1].heading_rad) << "of the attitude a field gets the tilt alone";
  EXPECT_FALSE(compass[1].heading_is_true || compass[1].heading_std_rad);
  EXPECT_EQ(compass[0].pitch_rad, -0.25);
  EXPECT_EQ(compass[1].roll_rad, 0.125);
  EXPECT_NEAR((*compass[1].field_body_uT)[0], 20, 1e-12);
  EXPECT_FALSE(compass[2].roll_rad);
}

TEST_F(Vehicle, CountersOfThirtyTwoBitsGoOn) {
  heartbeat();
  EXPECT_EQ(servo(100), Verdict::used);
  EXPECT_FALSE(newest_ns()) << "its upper half is not known yet";
  raw_imu((std::uint64_t{1} << 32) - 10'000);
  servo(5'000);
  EXPECT_EQ(newest_ns(), ((std::int64_t{1} << 32) + 5'000) * 1000);
  attitude(0xFFFFFFF0);
  const std::int64_t before_ns = *newest_ns();
  attitude(16);
  EXPECT_EQ(*newest_ns() - before_ns, 32'000'000);
}

TEST_F(Vehicle, ARestartBringsASmallerTime) {
  heartbeat();
  attitude(4'000'000);
  attitude(5'000);
  EXPECT_EQ(newest_ns(), 5'000'000'000);
  servo(5'010'000);
  EXPECT_EQ(newest_ns(), 5'010'000'000);
}

TEST_F(Vehicle, ADopplerLogsMotionIsReadFromWhoeverSendsIt) {
  const auto delta = [](std::uint64_t duration_us, float forward_m, float confidence) {
    return Fields{}
        .put(std::uint64_t{5})
        .put(duration_us)
        .put(0.1F)
        .put(0.2F)
        .put(0.3F)
        .put(forward_m)
        .put(-0.01F)
        .put(0.002F)
        .put(confidence);
  };
  EXPECT_EQ(send(11011, delta(200'000, 0.1F, 80), 255, 0), Verdict::ignored) << "no vehicle yet";
  heartbeat();
  EXPECT_EQ(send(11011, delta(200'000, 0.1F, 80), 255, 0), Verdict::used) << "as BlueOS' driver sends it";
  EXPECT_EQ(send(11011, delta(100'000, 0.1F, 80), 1, 1), Verdict::used);
  const auto all = collector.all<DvlSample>();
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].frame, VelocityFrame::body);
  ASSERT_TRUE(all[0].bottom_velocity_m_s && all[1].bottom_velocity_m_s);
  EXPECT_NEAR((*all[0].bottom_velocity_m_s)[0], 0.5, 1e-6);
  EXPECT_NEAR((*all[0].bottom_velocity_m_s)[1], -0.05, 1e-6);
  EXPECT_NEAR((*all[0].bottom_velocity_m_s)[2], 0.01, 1e-6);
  EXPECT_NEAR((*all[1].bottom_velocity_m_s)[0], 1, 1e-6);
  EXPECT_FALSE(collector.measurements.back().device_time_ns) << "of a clock that it does not name";
  EXPECT_EQ(send(11011, delta(0, 0.1F, 80)), Verdict::ignored);
  EXPECT_EQ(send(11011, delta(200'000, 0.1F, 0)), Verdict::ignored) << "of no confidence";
  EXPECT_EQ(send(11011, delta(200'000, std::numeric_limits<float>::quiet_NaN(), 80)), Verdict::ignored);
  EXPECT_EQ(send(11011, delta(0, 0.1F, 80), 255, 0), Verdict::foreign) << "counted as of another system";
}

TEST_F(Vehicle, AnotherComponentHasAClockOfItsOwn) {
  heartbeat();
  attitude(1000);
  const auto distance = Fields{}
                            .put(std::uint32_t{77'000})
                            .put(std::uint16_t{30})
                            .put(std::uint16_t{5000})
                            .put(std::uint16_t{1234})
                            .put(std::uint16_t{0})
                            .put(std::uint8_t{25})
                            .put(std::uint8_t{255});
  EXPECT_EQ(send(132, distance, 1, 194), Verdict::used);
  EXPECT_EQ(collector.measurements.back().clock, 194);
  EXPECT_EQ(newest_ns(), 77'000'000'000);
  EXPECT_NEAR(collector.all<AltimeterSample>().at(0).altitude_m, 12.34, 1e-12);
  EXPECT_EQ(send(132, distance, 1, 1), Verdict::ignored) << "the autopilot tells it again";
}

constexpr std::array<std::uint8_t, 32> kSigningKey{1, 2, 3};

std::vector<std::uint8_t> signed_by(mavlink::Signer& signer, std::vector<std::uint8_t> frame) {
  signer.sign(frame);
  return frame;
}

TEST(SignedVehicle, WithAKeyOnlyGoodSignaturesCount) {
  auto settings = port();
  settings.signing_key = kSigningKey;
  const auto instrument = make_instrument(settings);
  Collector collector{*instrument};
  mavlink::Signer signer{kSigningKey};
  const auto say = [&](const std::vector<std::uint8_t>& frame) {
    collector.feed<mavlink::Parser>(frame);
    return collector.verdicts.back();
  };
  const auto beat = Fields{}.put(std::uint32_t{0}).put(std::uint8_t{12}).put(std::uint8_t{3});
  const auto angles = Fields{}.put(1000U).put(0.125F).put(-0.25F).put(1.5F);
  EXPECT_EQ(say(mavlink::encode(0, {1, 1, 0}, beat.bytes)), Verdict::unsigned_);
  EXPECT_EQ(say(signed_by(signer, mavlink::encode(0, {1, 1, 0}, beat.bytes))), Verdict::ignored);
  auto attitude = signed_by(signer, mavlink::encode(30, {1, 1, 0}, angles.bytes));
  EXPECT_EQ(say(attitude), Verdict::used);
  EXPECT_EQ(say(attitude), Verdict::replayed);
  attitude.back() ^= 1U;
  EXPECT_EQ(say(attitude), Verdict::forged);
}

/// An autopilot that accepts what it can.
struct FakeAutopilot {
  bool has_high_resolution = true, is_deaf = false, knows_calibration = true;
  float motor_source = 0;
  std::vector<std::uint32_t> asked{};
  int heartbeats = 0;
  std::uint32_t ignored = 0;  ///< message that is not answered for
  std::vector<std::int64_t>
      way_back_ns{};               ///< of answers to TIMESYNC, the last one for all that follow; empty: none
  std::int64_t time_error_ns = 0;  ///< of what they say that they answer

  void operator()(test::Dialogue& dialogue, const std::string& command) {
    const auto found =
        mavlink::find_message({reinterpret_cast<const std::uint8_t*>(command.data()), command.size()});
    ASSERT_EQ(found.verdict, mavlink::Found::Verdict::frame);
    EXPECT_EQ(found.message.component, 197);
    if (found.message.id == 0) ++heartbeats;
    const mavlink::Payload payload(found.message.payload);
    if (found.message.id == 111 && !way_back_ns.empty()) {
      EXPECT_EQ(payload.at<std::int64_t>(0), 0);
      EXPECT_EQ(payload.at<std::int64_t>(8), dialogue.now_ns());
      say(dialogue, 111, Fields{}.put(std::int64_t{77}).put(dialogue.now_ns() + time_error_ns),
          way_back_ns.front());
      if (way_back_ns.size() > 1) way_back_ns.erase(way_back_ns.begin());
    }
    if (found.message.id == 20 && knows_calibration && !is_deaf) {
      EXPECT_EQ(payload.at<std::int16_t>(0), -1);
      const std::string name = payload.text(4, 16);
      const bool is_one = name.find("DIA") != std::string::npos;
      const float value = name == "COMPASS_MOTCT" ? motor_source : is_one ? 1.0F : 0.5F;
      if (name != "COMPASS_SCALE") say(dialogue, 22, parameter_value(name, value));
    }
    if (found.message.id != 76) return;
    EXPECT_EQ(payload.at<std::uint16_t>(28), 511);
    asked.push_back(static_cast<std::uint32_t>(payload.at<float>(0)));
    const std::uint8_t result = asked.back() == 105 && !has_high_resolution ? 3 : 0;
    if (!is_deaf && asked.back() != ignored) say(dialogue, 77, Fields{}.put(std::uint16_t{511}).put(result));
  }
  static void say(test::Dialogue& dialogue, std::uint32_t id, const Fields& fields,
                  std::int64_t delay_ns = 20 * base::kMillisecond_ns) {
    const auto frame = mavlink::encode(id, {1, 1, 0}, fields.bytes);
    dialogue.answer(mavlink::message_of(id)->name, {frame.begin(), frame.end()}, delay_ns);
  }
};

struct MavlinkDialogue : testing::Test {
  FakeAutopilot autopilot;
  test::Dialogue dialogue{make_start_up(port()),
                          [this](test::Dialogue& running, const std::string& text) { autopilot(running, text); }};
  void heartbeat() {
    FakeAutopilot::say(dialogue, 0, Fields{}.put(std::uint32_t{0}).put(std::uint8_t{12}).put(std::uint8_t{3}));
  }
  /// Seconds of an autopilot that has run for `boot_s` at first.
  void live(int seconds, std::uint32_t boot_s) {
    for (int i = 0; i < seconds; ++i) {
      heartbeat();
      FakeAutopilot::say(dialogue, 30, Fields{}.put(1000 * (boot_s + static_cast<std::uint32_t>(i))).put(0.5F));
      dialogue.run_for(base::kSecond_ns);
    }
  }
  /// Each change of the state is an event: the states of so many seconds.
  std::vector<std::string> states_of(std::uint32_t seconds) {
    std::vector<std::string> states;
    for (std::uint32_t i = 0; i < seconds; ++i) {
      if (states.empty() || states.back() != dialogue.state()) states.push_back(dialogue.state());
      live(1, 100 + i);
    }
    return states;
  }
};

TEST(MavlinkDialogueSigned, SignsWhatItSaysAndHearsOnlyTheSigned) {
  auto settings = port();
  settings.signing_key = kSigningKey;
  mavlink::Signer autopilot(kSigningKey);
  int heartbeats = 0;
  test::Dialogue dialogue(make_start_up(settings), [&](test::Dialogue&, const std::string& text) {
    const protocols::Bytes frame(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
    EXPECT_EQ(autopilot.check(frame), mavlink::Signer::Verdict::good);
    if (mavlink::find_message(frame).message.id == 0) ++heartbeats;
  });
  const auto beat = Fields{}.put(std::uint32_t{0}).put(std::uint8_t{12}).put(std::uint8_t{3});
  dialogue.begin();
  FakeAutopilot::say(dialogue, 0, beat);
  dialogue.run_for(3 * base::kSecond_ns);
  EXPECT_TRUE(dialogue.sent.empty()) << "a heartbeat without a signature";
  const auto frame = signed_by(autopilot, mavlink::encode(0, {1, 1, 0}, beat.bytes));
  dialogue.answer("HEARTBEAT", {frame.begin(), frame.end()});
  dialogue.run_for(3 * base::kSecond_ns);
  EXPECT_GT(heartbeats, 0);
}

TEST_F(MavlinkDialogue, WaitsForAnAutopilotAndAsksForItsMessages) {
  dialogue.begin();
  dialogue.run_for(5 * base::kSecond_ns);
  EXPECT_TRUE(dialogue.sent.empty());
  live(10, 100);
  EXPECT_EQ(autopilot.asked, (std::vector<std::uint32_t>{105, 36, 30, 147, 24, 137}));
  EXPECT_GE(autopilot.heartbeats, 8);
  EXPECT_TRUE(dialogue.start_up().in_service());
  EXPECT_EQ(dialogue.state(), "running, system 1; the compass's own calibration is undone");
}

TEST_F(MavlinkDialogue, ACalibrationByTheThrottleIsNotSaidToBeUndone) {
  autopilot.motor_source = 1;
  dialogue.begin();
  live(10, 100);
  EXPECT_EQ(dialogue.state(),
            "running, system 1; the compass's own calibration is not known, and stays in the field");
}

TEST_F(MavlinkDialogue, SaysThatTheCalibrationIsNotKnown) {
  autopilot.knows_calibration = false;
  dialogue.begin();
  live(10, 100);
  EXPECT_EQ(dialogue.state(),
            "running, system 1; the compass's own calibration is not known, and stays in the field");
}

TEST_F(MavlinkDialogue, WithoutHighResolutionItAsksForTheOther) {
  autopilot.has_high_resolution = false;
  dialogue.begin();
  live(10, 100);
  EXPECT_EQ(autopilot.asked, (std::vector<std::uint32_t>{105, 27, 36, 30, 147, 24, 137}));
}

TEST_F(MavlinkDialogue, AsksAgainAfterARestartAndInTime) {
  dialogue.begin();
  live(10, 100);
  live(5, 2);
  EXPECT_EQ(autopilot.asked.size(), 12U);
  live(40, 7);
  EXPECT_EQ(autopilot.asked.size(), 18U) << "a ground station may have asked for other rates";
}

TEST_F(MavlinkDialogue, SaysOnceWhatIsNotAnsweredAndThatItIsSilent) {
  autopilot.ignored = 24;
  dialogue.begin();
  EXPECT_EQ(states_of(600),
            (std::vector<std::string>{
                "waiting for the heartbeat of an autopilot", "asking system 1 for its messages",
                "running, system 1; the compass's own calibration is undone; no answer to: GPS_RAW_INT"}));
  dialogue.run_for(50 * base::kSecond_ns);
  EXPECT_NE(dialogue.state().find("waiting for the heartbeat"), std::string::npos) << dialogue.state();
}

TEST_F(MavlinkDialogue, TheLeastRoundTripBoundsHowLateTimesAre) {
  constexpr std::int64_t kMs = base::kMillisecond_ns;
  autopilot.way_back_ns = {30 * kMs, 90 * kMs, 45 * kMs, 70 * kMs, 70 * kMs,
                           70 * kMs, 70 * kMs, 4 * kMs,  70 * kMs};
  dialogue.begin();
  EXPECT_EQ(states_of(300), (std::vector<std::string>{
                                "waiting for the heartbeat of an autopilot", "asking system 1 for its messages",
                                "running, system 1; times late by at most 50 ms on the link; the compass's "
                                "own calibration is undone",
                                "running, system 1; times late by at most 5 ms on the link; the compass's "
                                "own calibration is undone"}));
  autopilot.way_back_ns = {400 * kMs};
  dialogue.run_for(20 * base::kSecond_ns);
  live(40, 500);
  EXPECT_NE(dialogue.state().find("at most 500 ms"), std::string::npos)
      << "another link, perhaps: " << dialogue.state();
}

TEST_F(MavlinkDialogue, AnAnswerToAnothersQuestionBoundsNothing) {
  autopilot.way_back_ns = {base::kMillisecond_ns};
  autopilot.time_error_ns = 1;
  dialogue.begin();
  live(10, 100);
  EXPECT_EQ(dialogue.state(), "running, system 1; the compass's own calibration is undone");
}

// A router's server endpoint sends and takes nothing. The requests without answer were said anew each round.
TEST_F(MavlinkDialogue, ALinkOfOneWayIsSaidOnceAndServes) {
  autopilot.is_deaf = true;
  dialogue.begin();
  EXPECT_EQ(states_of(3600), (std::vector<std::string>{
                                 "waiting for the heartbeat of an autopilot", "asking system 1 for its messages",
                                 "running, system 1; nothing answers, navcal goes on by what comes; the "
                                 "compass's own calibration is not known, and stays in the field"}));
  EXPECT_TRUE(dialogue.start_up().in_service());
  autopilot.is_deaf = false;
  live(40, 3700);
  EXPECT_EQ(dialogue.state(), "running, system 1; the compass's own calibration is undone");
}

}  // namespace
}  // namespace navcal::instruments
