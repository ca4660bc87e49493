// SPDX-License-Identifier: Apache-2.0
// The start-up dialogue and the user calibration of a PNI compass against the emulated one, on simulated time.
#include <gtest/gtest.h>

#include <functional>
#include <numbers>

#include "base/durations.h"
#include "instruments/compass_calibration.h"
#include "instruments/start_up.h"
#include "protocols/trax.h"
#include "sim/instruments/pni_unit.h"
#include "tests/instruments/dialogue.h"

namespace navcal::instruments::test {
namespace {

namespace trax = protocols::trax;

/// Turns at a steady rate.
struct TurningCompass : sim::Motion {
  double rate_deg_s = 12;
  [[nodiscard]] sim::State at(std::int64_t t_ns) const override {
    const double t_s = static_cast<double>(t_ns % (3600 * base::kSecond_ns)) * 1e-9;
    sim::State state;
    state.specific_force_m_s2 = {0, 0, -sim::kGravity_m_s2};
    state.euler_rad = {0.3 * std::sin(t_s / 3), 0.25 * std::sin(t_s / 4),
                       rate_deg_s * t_s * std::numbers::pi / 180};
    return state;
  }
};

class PniBench {
 public:
  explicit PniBench(const sim::PniUnit::Options& options = {}) : unit_(options, motion) {
    config::PortSettings port;
    port.protocol = protocols::Protocol::pni;
    port.rate_Hz = 10;
    start_up = make_start_up(port);
    unit_.power_on(now_ns);
    start_up->begin(now_ns);
  }
  /// As a session of navcald: the start-up is silent while the calibration is under way.
  void run_for(double seconds) {
    const std::int64_t end_ns = now_ns + static_cast<std::int64_t>(seconds * 1e9);
    for (; now_ns < end_ns; now_ns += base::kMillisecond_ns) {
      std::vector<sim::Emission> emissions;
      unit_.advance(now_ns, emissions);
      for (const auto& emission : emissions) {
        parser_.feed(emission.bytes, [&](const protocols::Frame& frame) {
          if (frame.id.view() == "DataResp") ++data;
          if (!passes(frame.id.view())) return;
          calibration.on_frame(frame, now_ns);
          start_up->on_frame(frame, now_ns);
        });
      }
      if (calibration.busy()) {
        send([&] { return calibration.next(now_ns); });
      } else if (start_up->deadline_ns() <= now_ns) {
        send([&] { return start_up->next(now_ns); });
      }
    }
  }
  /// Frame numbers of the commands, without kGetData.
  [[nodiscard]] std::string transcript() const {
    std::string text;
    for (const Sent& command : sent) {
      const int number = static_cast<unsigned char>(command.text[2]);
      if (number != 4) text += std::to_string(number) + ' ';
    }
    return text;
  }
  void power_cycle() { unit_.power_on(now_ns); }

  TurningCompass motion;
  std::unique_ptr<StartUp> start_up;
  std::unique_ptr<CompassCalibration> made = calibrate_pni(120 * base::kSecond_ns);
  CompassCalibration& calibration = *made;
  std::vector<Sent> sent;
  bool hears = true;
  std::function<bool(std::string_view)> passes = [](std::string_view) { return true; };
  int data = 0;
  std::int64_t now_ns = 1'764'000'000 * base::kSecond_ns;

 private:
  template <class Next>
  void send(Next next) {
    while (const auto bytes = next()) {
      sent.push_back({now_ns, {bytes->begin(), bytes->end()}});
      if (hears) unit_.on_bytes(now_ns, *bytes);
    }
  }
  sim::PniUnit unit_;
  trax::Parser parser_;
};

constexpr const char* kPniWhole = "22 1 6 6 6 24 3 21 ";
constexpr const char* kPniCalibration = "22 6 6 10 21 ";

TEST(StartUpPni, ConfiguresAndRunsOfItself) {
  PniBench bench;
  bench.run_for(20);
  EXPECT_EQ(bench.transcript(), kPniWhole);
  EXPECT_EQ(bench.start_up->state(), "running");
  EXPECT_NEAR(bench.data, 195, 10) << "10 Hz";
}

TEST(StartUpPni, ADeviceWithoutContinuousOutputIsPolled) {
  sim::PniUnit::Options options;
  options.has_continuous = false;
  PniBench bench(options);
  bench.run_for(20);
  EXPECT_EQ(bench.transcript(), std::string(kPniWhole) + "22 1 6 6 6 24 3 ");
  EXPECT_EQ(bench.start_up->state(), "running, polled");
  EXPECT_GT(bench.data, 140);
}

TEST(StartUpPni, LostAnswersAreRepeated) {
  PniBench bench;
  int answers = 0;
  bench.passes = [&](std::string_view id) { return id == "DataResp" || ++answers % 2 == 0; };
  bench.run_for(15);
  EXPECT_EQ(bench.transcript(), "22 1 1 6 6 6 6 6 6 24 24 3 21 ");
  EXPECT_EQ(bench.start_up->state(), "running");
}

TEST(StartUpPni, AnswersThatNeverComeAreNamed) {
  PniBench bench;
  bench.passes = [&](std::string_view id) { return id == "DataResp" || id == "ModInfoResp"; };
  bench.run_for(20);
  EXPECT_EQ(bench.start_up->state(), "running; no answer to: magnetic north, degrees, byte order, acquisition");
}

TEST(StartUpPni, ADeviceThatDoesNotHearIsAskedEveryTenSeconds) {
  PniBench bench;
  bench.hears = false;
  bench.run_for(30);
  EXPECT_EQ(bench.start_up->state().rfind("no answer: trying again every 10 s", 0), 0U) << bench.start_up->state();
  EXPECT_LE(bench.sent.size(), 12U);
  bench.hears = true;
  bench.run_for(20);
  EXPECT_EQ(bench.start_up->state(), "running");
}

TEST(StartUpPni, BeginsAnewWhenTheDataStop) {
  PniBench bench;
  bench.run_for(5);
  bench.power_cycle();
  bench.run_for(10);
  EXPECT_EQ(bench.transcript(), std::string(kPniWhole) + kPniWhole);
  EXPECT_EQ(bench.start_up->state(), "running");
}

TEST(PniCalibration, TwelveSamplesAndTheScore) {
  PniBench bench;
  bench.run_for(5);
  EXPECT_EQ(bench.calibration.state(), "not begun");
  bench.calibration.begin(bench.now_ns);
  bench.run_for(10);
  EXPECT_TRUE(bench.calibration.busy());
  EXPECT_EQ(bench.calibration.state().substr(1), " of 12 samples") << bench.calibration.state();
  bench.run_for(40);
  EXPECT_EQ(bench.transcript(), std::string(kPniWhole) + kPniCalibration);
  ASSERT_EQ(bench.calibration.figures().size(), 5U);
  EXPECT_EQ(bench.calibration.figures()[0].name, "magnetometer");
  EXPECT_LT(bench.calibration.figures()[0].value, 0.6) << "samples all around";
  EXPECT_TRUE(bench.calibration.touched());
  EXPECT_EQ(bench.calibration.failure(), "");
  EXPECT_EQ(bench.calibration.state().rfind("score ", 0), 0U);
  const int before = bench.data;
  bench.run_for(5);
  EXPECT_GT(bench.data, before + 40) << "back in service";
}

TEST(PniCalibration, TheResultIsSavedOnOrderOnly) {
  PniBench bench;
  bench.run_for(5);
  EXPECT_EQ(bench.calibration.save(bench.now_ns), "there is no result that the compass could keep");
  bench.calibration.begin(bench.now_ns);
  EXPECT_NE(bench.calibration.save(bench.now_ns), "");
  bench.run_for(60);
  EXPECT_NE(bench.calibration.state().find("kept until the compass loses its power"), std::string::npos);
  EXPECT_EQ(bench.calibration.save(bench.now_ns), "");
  bench.run_for(5);
  EXPECT_EQ(bench.transcript(), std::string(kPniWhole) + kPniCalibration + "9 ");
  EXPECT_NE(bench.calibration.state().find("saved"), std::string::npos) << bench.calibration.state();
}

TEST(PniCalibration, AVehicleThatDoesNotTurnGivesNoScore) {
  PniBench bench;
  bench.motion.rate_deg_s = 0;
  bench.run_for(5);
  bench.calibration.begin(bench.now_ns);
  bench.run_for(130);
  EXPECT_EQ(bench.calibration.state(), "failed: only 1 of 12 samples in 2 minutes");
  EXPECT_TRUE(bench.calibration.figures().empty());
  EXPECT_EQ(bench.transcript(), std::string(kPniWhole) + "22 6 6 10 11 21 ") << "it is told to stop calibrating";
}

TEST(PniCalibration, TheOperatorCallsItOff) {
  PniBench bench;
  bench.run_for(5);
  bench.calibration.begin(bench.now_ns);
  bench.run_for(8);
  bench.calibration.stop(bench.now_ns);
  bench.run_for(10);
  EXPECT_EQ(bench.calibration.state().rfind("failed: called off after ", 0), 0U) << bench.calibration.state();
  EXPECT_FALSE(bench.calibration.busy());
}

TEST(PniCalibration, ADeviceThatIsAwayGivesAReason) {
  PniBench bench;
  bench.run_for(5);
  bench.hears = false;
  bench.calibration.begin(bench.now_ns);
  bench.run_for(20);
  EXPECT_EQ(bench.calibration.state(), "failed: no answer to the number of samples");
  bench.calibration.begin(bench.now_ns);
  bench.calibration.abandon("the compass went away");
  EXPECT_EQ(bench.calibration.state(), "failed: the compass went away");
}

}  // namespace
}  // namespace navcal::instruments::test
