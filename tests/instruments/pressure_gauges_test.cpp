// SPDX-License-Identifier: Apache-2.0
// Pressure gauges and their start-up dialogues.
#include <gtest/gtest.h>

#include <limits>

#include "protocols/keller.h"
#include "protocols/paroscientific.h"
#include "tests/instruments/collector.h"
#include "tests/instruments/dialogue.h"

namespace navcal::instruments::test {
namespace {

namespace keller = protocols::keller;
namespace paroscientific = protocols::paroscientific;
using Verdict = Instrument::Verdict;
using protocols::Protocol;

config::PortSettings gauge_port(Protocol protocol, bool start_up = true) {
  config::PortSettings port;
  port.protocol = protocol;
  port.start_up = start_up;
  return port;
}

std::string text(const std::vector<std::uint8_t>& bytes) { return {bytes.begin(), bytes.end()}; }

TEST(ParoscientificGauge, AValueCountsOnceItsUnitIsKnown) {
  Collector collector(gauge_port(Protocol::paroscientific));
  collector.feed<paroscientific::Parser>(
      "*000114.69595\r\n*0001UN=1\r\n*000114.69595\r\n*0001UN=2\r\n*00011013.25\r\n");
  const auto samples = collector.all<DepthSample>();
  ASSERT_EQ(samples.size(), 2U);
  EXPECT_NEAR(samples[0].pressure_Pa.value(), 101325, 1);
  EXPECT_NEAR(samples[1].pressure_Pa.value(), 101325, 1e-6);
  EXPECT_EQ(collector.verdicts,
            (std::vector{Verdict::ignored, Verdict::used, Verdict::used, Verdict::used, Verdict::used}));
  collector.feed<paroscientific::Parser>("*0001UN=0\r\n*00011013.25\r\n*0001UN=x\r\n");
  EXPECT_EQ(collector.all<DepthSample>().size(), 2U) << "a unit of its owner is not known";
  EXPECT_EQ(collector.verdicts.back(), Verdict::out_of_range);
}

TEST(ParoscientificGauge, WithoutADialogueTheUnitIsThatOfDelivery) {
  Collector collector(gauge_port(Protocol::paroscientific, false));
  collector.feed<paroscientific::Parser>("*000114.69595\r\n");
  EXPECT_NEAR(collector.all<DepthSample>().at(0).pressure_Pa.value(), 101325, 1);
}

TEST(ParoscientificGauge, EchoesAreIgnored) {
  Collector collector(gauge_port(Protocol::paroscientific, false));
  collector.feed<paroscientific::Parser>("*0100P4\r\n*0100UN\r\n*000190\r\n");
  EXPECT_EQ(collector.verdicts, std::vector<Verdict>(3, Verdict::ignored));
  EXPECT_TRUE(collector.measurements.empty());
}

TEST(KellerGauge, BarBecomesPascal) {
  Collector collector(Protocol::keller);
  collector.feed<keller::Parser>(keller::read_request(250, 1));
  collector.feed<keller::Parser>(keller::encode(keller::Reading{250, 1.5F, 0}));
  EXPECT_EQ(collector.verdicts, (std::vector{Verdict::ignored, Verdict::used}));
  EXPECT_EQ(collector.all<DepthSample>().at(0).pressure_Pa, 150000);
}

TEST(KellerGauge, WhatFailedIsCounted) {
  Collector collector(Protocol::keller);
  constexpr std::uint8_t kPressureFailed = 2;
  for (const keller::Reading& reading : {keller::Reading{250, 1.5F, kPressureFailed},
                                         keller::Reading{250, std::numeric_limits<float>::infinity(), 0},
                                         keller::Reading{250, std::numeric_limits<float>::quiet_NaN(), 0}}) {
    collector.feed<keller::Parser>(keller::encode(reading));
  }
  EXPECT_EQ(collector.verdicts, std::vector<Verdict>(3, Verdict::out_of_range));
  EXPECT_TRUE(collector.measurements.empty());
}

/// Answers like a gauge, from power-on; values follow P4.
struct ParoscientificByHand {
  bool is_deaf = false, sends_values = false;
  int unit = 1, swallowed = 0;

  void operator()(Dialogue& dialogue, const std::string& command) {
    if (is_deaf || swallowed-- > 0) return;
    sends_values = false;
    if (command == "*0100UN\r\n") dialogue.answer("UN", "*0001UN=" + std::to_string(unit) + "\r\n");
    if (command == "*0100P4\r\n") sends_values = true;
  }
};

struct ParoscientificDialogue {
  ParoscientificByHand gauge;
  Dialogue dialogue{make_start_up(gauge_port(Protocol::paroscientific)),
                    [this](Dialogue& with, const std::string& command) { gauge(with, command); }};

  void run_for(std::int64_t duration_ns) {
    dialogue.run_for(duration_ns, [this] {
      if (gauge.sends_values && dialogue.now_ns() % base::kSecond_ns == 0)
        dialogue.frame("VALUE", "*000114.69595\r\n");
    });
  }
};

TEST(StartUpParoscientific, AsksForTheUnitAndThenForContinuousValues) {
  ParoscientificDialogue one;
  one.dialogue.begin();
  one.run_for(60 * base::kSecond_ns);
  EXPECT_EQ(one.dialogue.transcript(), "*0100UN \n*0100P4 \n");
  EXPECT_EQ(one.dialogue.state(), "running, UN=1");
}

TEST(StartUpParoscientific, LostCommandsAreRepeated) {
  ParoscientificDialogue one;
  one.gauge.swallowed = 2;
  one.dialogue.begin();
  one.run_for(30 * base::kSecond_ns);
  EXPECT_EQ(one.dialogue.transcript(), "*0100UN \n*0100UN \n*0100UN \n*0100P4 \n");
  EXPECT_EQ(one.dialogue.state(), "running, UN=1");
}

TEST(StartUpParoscientific, ADeafGaugeIsReportedAndAskedForEver) {
  ParoscientificDialogue one;
  one.gauge.is_deaf = true;
  one.dialogue.begin();
  one.run_for(60 * base::kSecond_ns);
  EXPECT_NE(one.dialogue.state().find("no answer"), std::string::npos) << one.dialogue.state();
  EXPECT_TRUE(never_repeated_within(one.dialogue.sent, 2 * base::kSecond_ns));
  one.gauge.is_deaf = false;
  one.run_for(10 * base::kSecond_ns);
  EXPECT_EQ(one.dialogue.state(), "running, UN=1");
}

TEST(StartUpParoscientific, BeginsAnewWhenTheGaugeWasRestarted) {
  ParoscientificDialogue one;
  one.dialogue.begin();
  one.run_for(10 * base::kSecond_ns);
  one.gauge.sends_values = false;  // its power was off
  one.run_for(30 * base::kSecond_ns);
  EXPECT_EQ(one.dialogue.transcript(), "*0100UN \n*0100P4 \n*0100UN \n*0100P4 \n");
  EXPECT_EQ(one.dialogue.state(), "running, UN=1");
}

TEST(StartUpParoscientific, AUnitThatIsNotKnownIsSaid) {
  ParoscientificDialogue one;
  one.gauge.unit = 0;
  one.dialogue.begin();
  one.run_for(10 * base::kSecond_ns);
  EXPECT_NE(one.dialogue.state().find("not known (UN=0)"), std::string::npos) << one.dialogue.state();
}

TEST(StartUpParoscientific, IsOffWhereItIsNotWanted) {
  EXPECT_EQ(make_start_up(gauge_port(Protocol::paroscientific, false)), nullptr);
  EXPECT_EQ(make_start_up(gauge_port(Protocol::keller, false)), nullptr);
}

/// A transmitter on the bus.
struct KellerByHand {
  bool is_deaf = false, is_initialised = false, refuses = false;

  void operator()(Dialogue& dialogue, const std::string& request) {
    if (is_deaf) return;
    constexpr std::int64_t kDelay_ns = 3 * base::kMillisecond_ns;
    if (request == text(keller::initialise_request(250))) {
      is_initialised = true;
      dialogue.answer("F48", text(keller::encode(keller::Identity{250, 5, 20, 12, 10, 13, 0})), kDelay_ns);
    } else if (!is_initialised || refuses) {
      const std::uint8_t error = refuses ? 2 : 32;
      dialogue.answer("ERROR", text(keller::encode(keller::Refusal{250, 73, error})), kDelay_ns);
    } else {
      dialogue.answer("F73", text(keller::encode(keller::Reading{250, 1.0F, 0})), kDelay_ns);
    }
  }
};

struct KellerDialogue {
  KellerByHand transmitter;
  Dialogue dialogue{make_start_up(gauge_port(Protocol::keller)),
                    [this](Dialogue& with, const std::string& request) { transmitter(with, request); }};

  [[nodiscard]] std::size_t count(const std::vector<std::uint8_t>& request) const {
    return static_cast<std::size_t>(std::count_if(dialogue.sent.begin(), dialogue.sent.end(),
                                                  [&](const Sent& sent) { return sent.text == text(request); }));
  }
};

TEST(StartUpKeller, InitialisesOnceAndAsksTenTimesASecond) {
  KellerDialogue one;
  one.dialogue.begin();
  one.dialogue.run_for(10 * base::kSecond_ns);
  EXPECT_EQ(one.count(keller::initialise_request(250)), 1U);
  EXPECT_NEAR(static_cast<double>(one.count(keller::read_request(250, 1))), 100, 1);
  EXPECT_EQ(one.dialogue.sent.size(), one.count(keller::read_request(250, 1)) + 1) << "nothing else";
  EXPECT_EQ(one.dialogue.state(), "running, asked ten times a second");
}

TEST(StartUpKeller, ATransmitterThatLostItsPowerIsInitialisedAnew) {
  KellerDialogue one;
  one.dialogue.begin();
  one.dialogue.run_for(5 * base::kSecond_ns);
  one.transmitter.is_initialised = false;
  one.dialogue.run_for(1 * base::kSecond_ns);
  EXPECT_EQ(one.count(keller::initialise_request(250)), 2U);
  EXPECT_EQ(one.dialogue.state(), "running, asked ten times a second");
}

TEST(StartUpKeller, ASilentOneIsAskedTwiceASecondUntilItIsBack) {
  KellerDialogue one;
  one.dialogue.begin();
  one.dialogue.run_for(2 * base::kSecond_ns);
  one.transmitter.is_deaf = true;
  one.dialogue.run_for(2 * base::kSecond_ns);
  one.dialogue.sent.clear();
  one.dialogue.run_for(10 * base::kSecond_ns);
  EXPECT_NEAR(static_cast<double>(one.dialogue.sent.size()), 20, 1);
  EXPECT_EQ(one.count(keller::read_request(250, 1)), 0U);
  EXPECT_NE(one.dialogue.state().find("no answer"), std::string::npos);
  one.transmitter.is_deaf = false;
  one.dialogue.run_for(1 * base::kSecond_ns);
  EXPECT_EQ(one.dialogue.state(), "running, asked ten times a second");
}

TEST(StartUpKeller, ARefusalIsSaid) {
  KellerDialogue one;
  one.transmitter.refuses = true;
  one.dialogue.begin();
  one.dialogue.run_for(500 * base::kMillisecond_ns);
  EXPECT_EQ(one.dialogue.state(), "the transmitter refuses, error 2");
}

}  // namespace
}  // namespace navcal::instruments::test
