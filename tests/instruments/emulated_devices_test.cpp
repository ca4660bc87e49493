// SPDX-License-Identifier: Apache-2.0
// Emulated u-blox receivers and VectorNav sensors of several kinds with their start-up dialogues, over a line that
// loses commands, through a loss of power.
#include <gtest/gtest.h>

#include <random>

#include "config/load.h"
#include "instruments/start_up.h"
#include "protocols/ubx.h"
#include "protocols/vectornav.h"
#include "sim/instruments/ubx_receiver.h"
#include "sim/instruments/vectornav.h"
#include "tests/instruments/collector.h"

namespace navcal::instruments {
namespace {

constexpr std::int64_t kBegin_ns = 1'764'000'000'000'000'000;
constexpr std::int64_t kStep_ns = 5'000'000;

struct Afloat : sim::Motion {
  sim::State state;
  Afloat() {
    state.specific_force_m_s2 = {0, 0, -sim::kGravity_m_s2};
    state.velocity_body_m_s = {1, 0, 0};
  }
  [[nodiscard]] sim::State at(std::int64_t) const override { return state; }
};

/// A device with its dialogue and its instrument. A share of the commands is lost.
template <class Parser>
class Bench {
 public:
  Bench(sim::Device& device, const config::PortSettings& port, double lost = 0)
      : device_(device), instrument_(make_instrument(port)), start_up_(make_start_up(port)), lost_(lost) {
    device_.power_on(now_ns_);
    start_up_->begin(now_ns_);
  }
  void run(double seconds) {
    const std::int64_t end_ns = now_ns_ + static_cast<std::int64_t>(seconds * 1e9);
    for (; now_ns_ < end_ns; now_ns_ += kStep_ns) {
      std::vector<sim::Emission> emissions;
      device_.advance(now_ns_, emissions);
      for (const sim::Emission& emission : emissions) {
        parser_.feed(emission.bytes, [this](const protocols::Frame& frame) {
          start_up_->on_frame(frame, now_ns_);
          if (instrument_->read(frame, collector_) == Instrument::Verdict::out_of_range) ++out_of_range;
        });
      }
      while (const auto bytes = start_up_->next(now_ns_)) {
        if (std::bernoulli_distribution(lost_)(random_)) continue;
        device_.on_bytes(now_ns_, *bytes);
      }
    }
  }
  void power_cycle() { device_.power_on(now_ns_); }
  /// The samples since the last call.
  template <class Sample>
  std::vector<Sample> fresh() {
    auto samples = collector_.template all<Sample>();
    collector_.measurements.clear();
    return samples;
  }
  [[nodiscard]] std::string state() const { return start_up_->state(); }
  int out_of_range = 0;

 private:
  sim::Device& device_;
  std::unique_ptr<Instrument> instrument_;
  Collector collector_{*instrument_};
  std::unique_ptr<StartUp> start_up_;
  Parser parser_;
  std::mt19937 random_{7};
  double lost_;
  std::int64_t now_ns_ = kBegin_ns;
};

config::PortSettings port_at(protocols::Protocol protocol) {
  auto port = config::default_port("device", protocol, config::default_baud(protocol));
  port.path = "/dev/ttyUSB0";
  return port;
}

using Generation = sim::UbxReceiver::Generation;
using protocols::ubx::ReceiverPort;

TEST(EmulatedDevices, UbxReceiversOfEveryKindGivePositionsWithTheirErrors) {
  const std::pair<Generation, ReceiverPort> kinds[] = {{Generation::nine, ReceiverPort::uart1},
                                                       {Generation::nine, ReceiverPort::uart2},
                                                       {Generation::nine, ReceiverPort::usb},
                                                       {Generation::eight, ReceiverPort::uart1}};
  for (const auto& [generation, receiver_port] : kinds) {
    for (const double lost : {0.0, 0.3}) {
      const Afloat motion;
      sim::UbxReceiver::Options options;
      options.generation = generation;
      options.port = receiver_port;
      sim::UbxReceiver device(options, motion);
      const auto port = port_at(protocols::Protocol::ubx);
      Bench<protocols::ubx::PortParser> bench(device, port, lost);
      bench.run(120);
      for (int power = 0; power < 2; ++power) {
        EXPECT_TRUE(bench.state().starts_with("running on NAV-PVT")) << bench.state();
        bench.fresh<GpsSample>();
        bench.run(10);
        const auto fixes = bench.fresh<GpsSample>();
        EXPECT_EQ(fixes.size(), 10U);
        for (const GpsSample& fix : fixes) {
          EXPECT_TRUE(fix.position_std_m && fix.velocity_std_m_s && fix.latitude_rad);
          EXPECT_TRUE(fix.leap_known);
        }
        bench.power_cycle();
        bench.run(120);
      }
      EXPECT_EQ(bench.out_of_range, 0);
    }
  }
}

TEST(EmulatedDevices, AReceiverWithoutNavPvtIsReadByItsSentences) {
  const Afloat motion;
  sim::UbxReceiver::Options options;
  options.generation = Generation::six;
  sim::UbxReceiver device(options, motion);
  const auto port = port_at(protocols::Protocol::ubx);
  Bench<protocols::ubx::PortParser> bench(device, port);
  bench.run(60);
  EXPECT_TRUE(bench.state().find("refused: CFG-VALSET for UART1, CFG-MSG for NAV-PVT") != std::string::npos)
      << bench.state();
  bench.fresh<GpsSample>();
  bench.run(10);
  EXPECT_EQ(bench.fresh<GpsSample>().size(), 10U);
}

TEST(EmulatedDevices, VectorNavSensorsOfEveryKindGiveRatesAndAttitude) {
  struct Kind {
    int port;
    bool has_errors, is_bare;
    std::string state;
  };
  const Kind kinds[] = {{1, true, false, "running on binary messages"},
                        {2, true, false, "running on binary messages"},
                        {1, false, false, "running on binary messages"},
                        {2, false, false, "running on binary messages"},
                        {1, true, true, "running on lines"}};
  for (const Kind& kind : kinds) {
    for (const double lost : {0.0, 0.3}) {
      const Afloat motion;
      sim::VectorNav::Options options;
      options.port = kind.port;
      options.has_errors = kind.has_errors;
      options.is_bare = kind.is_bare;
      sim::VectorNav device(options, motion);
      Bench<protocols::vectornav::Parser> bench(device, port_at(protocols::Protocol::vectornav), lost);
      bench.run(30);
      for (int power = 0; power < 2; ++power) {
        if (lost == 0) {
          EXPECT_TRUE(bench.state().starts_with(kind.state)) << bench.state();
        }
        bench.fresh<ImuSample>();
        bench.run(5);
        EXPECT_NEAR(static_cast<double>(bench.fresh<ImuSample>().size()), 200, 3) << bench.state();
        bench.run(1);
        const auto attitudes = bench.fresh<CompassSample>();
        ASSERT_FALSE(attitudes.empty());
        EXPECT_TRUE(attitudes.back().heading_rad && attitudes.back().field_body_uT);
        if (lost == 0) {
          EXPECT_EQ(attitudes.back().heading_std_rad.has_value(), kind.has_errors && !kind.is_bare);
        }
        bench.power_cycle();
        bench.run(30);
      }
      EXPECT_EQ(bench.out_of_range, 0);
    }
  }
}

}  // namespace
}  // namespace navcal::instruments
