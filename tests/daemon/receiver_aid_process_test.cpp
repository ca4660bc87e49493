// SPDX-License-Identifier: Apache-2.0
// A receiver that has lost its power is given position and time, on a real pseudo-terminal, and has a fix sooner.
#include <gtest/gtest.h>

#include <chrono>
#include <optional>

#include "protocols/oncore_command.h"
#include "protocols/oncore_position.h"
#include "record/recording.h"
#include "sim/instruments/oncore.h"
#include "tests/daemon/daemon_process.h"

namespace navcal::daemon {
namespace {

namespace oncore = protocols::oncore;

constexpr std::int64_t kSecond_ns = 1'000'000'000;

struct AtTheSurface : sim::Motion {
  [[nodiscard]] sim::State at(std::int64_t) const override { return {}; }
};

std::int64_t utc_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::system_clock::now().time_since_epoch())
      .count();
}

protocols::Bytes bytes_of(std::string_view text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

/// An emulated receiver at the daemon's line, at the pace of the clock.
class Receiver {
 public:
  explicit Receiver(const FakeLine& line) : line_(line), device_(options(), motion_) {}

  void power_on() {
    device_.power_on(utc_ns());
    fixed_ = false;
    powered_ns_ = utc_ns();
  }
  void take(protocols::Bytes bytes) { device_.on_bytes(utc_ns(), bytes); }
  /// Until its first fix; seconds since power-on. Nullopt: none within the limit.
  std::optional<double> run_until_fix(double limit_s) {
    while (utc_ns() - powered_ns_ < static_cast<std::int64_t>(limit_s * 1e9)) {
      const std::string sent = line_.read(50);
      take(bytes_of(sent));
      heard_ += sent;
      std::vector<sim::Emission> out;
      const std::int64_t now_ns = utc_ns();
      while (device_.next_event_ns() <= now_ns) device_.advance(device_.next_event_ns(), out);
      for (const auto& emission : out) {
        line_.write({reinterpret_cast<const char*>(emission.bytes.data()), emission.bytes.size()});
        const auto position = oncore::decode_position(emission.bytes);
        fixed_ = fixed_ || (position && position->fix == protocols::Fix::fix_3d);
      }
      if (fixed_) return static_cast<double>(utc_ns() - powered_ns_) * 1e-9;
    }
    return std::nullopt;
  }
  [[nodiscard]] const std::string& heard() const { return heard_; }
  [[nodiscard]] static sim::Oncore::Options options() {
    sim::Oncore::Options options;
    options.receiver.gps.search_model = config::SearchModel::receiver_state;
    options.receiver.gps.warm_start_s = 1;
    options.receiver.gps.cold_start_s = 300;
    return options;
  }

 private:
  const FakeLine& line_;
  AtTheSurface motion_;
  sim::Oncore device_;
  std::string heard_;
  std::int64_t powered_ns_ = 0;
  bool fixed_ = false;
};

/// A whole command in what was heard.
bool heard_command(const std::string& heard, const char* start, std::size_t length) {
  const std::size_t at = heard.find(start);
  return at != std::string::npos && at + length <= heard.size();
}

/// A daemon whose line has an Oncore, with a receiver that has had a fix and lost its power.
class ReceiverAid : public testing::Test {
 protected:
  void begin(bool aid) {
    process_.emplace(std::vector<std::string>{"--set", "port.compass.protocol=oncore", "--set",
                                              aid ? "port.compass.aid=true" : "port.compass.aid=false"});
    process_->wait_until_ready();
    receiver_.emplace(process_->line);
    receiver_->power_on();
    // Here the test makes the first start a warm one.
    receiver_->take(oncore::encode_aid_time(utc_ns()));
    const auto origin = Receiver::options().receiver.origin;
    receiver_->take(oncore::encode_aid_position({origin.latitude_deg, origin.longitude_deg, 0}));
    ASSERT_TRUE(receiver_->run_until_fix(60)) << process_->diagnostics();
    ASSERT_EQ(receiver_->heard().find("@@Ga"), std::string::npos) << "a receiver with a fix is left alone";
    receiver_->power_on();
  }
  std::optional<DaemonProcess> process_;
  std::optional<Receiver> receiver_;
};

TEST_F(ReceiverAid, GivesPositionAndTimeAfterALossOfPowerAndLogsThem) {
  begin(true);
  const auto search_s = receiver_->run_until_fix(120);
  ASSERT_TRUE(search_s) << "a cold start takes 210 s and more here";
  EXPECT_TRUE(heard_command(receiver_->heard(), "@@Ga", oncore::kGaLength));
  EXPECT_TRUE(heard_command(receiver_->heard(), "@@Gb", oncore::kGbLength));
  EXPECT_EQ(process_->stop(SIGTERM), 0);
  const auto recording = record::Recording::open(process_->logs().front().string());
  std::string sent;
  bool told = false;
  while (const auto entry = recording->next()) {
    if (const auto* raw = std::get_if<record::RawRead>(&*entry); raw && raw->direction == record::Direction::sent)
      sent.append(raw->bytes.begin(), raw->bytes.end());
    if (const auto* event = std::get_if<record::LoggedEvent>(&*entry))
      told = told || event->json.find("receiver.aid") != std::string::npos;
  }
  EXPECT_TRUE(heard_command(sent, "@@Ga", oncore::kGaLength));
  EXPECT_TRUE(heard_command(sent, "@@Gb", oncore::kGbLength));
  EXPECT_TRUE(told);
}

TEST_F(ReceiverAid, IsNotGivenUnlessConfigured) {
  begin(false);
  EXPECT_FALSE(receiver_->run_until_fix(12));
  EXPECT_EQ(receiver_->heard().find("@@Ga"), std::string::npos);
}

}  // namespace
}  // namespace navcal::daemon
