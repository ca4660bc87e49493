// SPDX-License-Identifier: Apache-2.0
// A compass that runs 1 % slow, on a pseudo-terminal: times of validity in the log against when it measured.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

#include "pipeline/pipeline.h"
#include "protocols/tcm2_word.h"
#include "record/recording.h"
#include "tests/daemon/daemon_process.h"

namespace navcal::daemon {
namespace {

constexpr double kNominal_Hz = 20;
constexpr double kFactor = 0.99;
constexpr int kWords = 200;
constexpr int kLearning = 100;

struct Stamps : pipeline::Sink {
  void on_sample(const instruments::Sample& sample) override {
    if (!std::holds_alternative<instruments::CompassSample>(sample.value)) return;
    validity_ns.push_back(sample.stamp.validity_ns);
  }
  void on_stream_event(const pipeline::StreamEvent& event) override { events.emplace_back(event.name); }
  std::vector<std::int64_t> validity_ns;
  std::vector<std::string> events;
};

/// The log as replay sees it, with the events that the daemon wrote.
Stamps replay(const std::filesystem::path& log, std::vector<std::string>& logged) {
  const auto recording = record::Recording::open(log);
  pipeline::Pipeline pipeline(recording->settings());
  Stamps stamps;
  while (const auto entry = recording->next()) {
    if (const auto* raw = std::get_if<record::RawRead>(&*entry)) {
      if (raw->direction == record::Direction::received)
        pipeline.bytes(raw->port, raw->time_ns, raw->bytes, stamps);
    } else if (const auto* event = std::get_if<record::LoggedEvent>(&*entry)) {
      if (event->json.find("clock.") != std::string::npos) logged.push_back(event->json);
    }
  }
  return stamps;
}

TEST(SlowInstrument, IsStampedWhenItMeasuredAndItsRateIsToldOnce) {
  DaemonProcess daemon({"--set", "port.compass.protocol=tcm2", "--set", "port.compass.rate_Hz=20", "--set",
                        "port.compass.latency_ms=0", "--set", "port.compass.start_up=false", "--set",
                        "port.compass.baud=38400"});
  daemon.wait_until_ready();
  protocols::tcm2::Word word;
  word.heading = 123.4;
  const auto bytes = protocols::tcm2::encode_word(word);
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const double wire_s = static_cast<double>(bytes.size()) * 10 / 38400;

  using Clock = std::chrono::steady_clock;  // CLOCK_MONOTONIC, as the log's
  const auto begin = Clock::now() + std::chrono::milliseconds(50);
  std::vector<double> true_s;
  for (int k = 0; k < kWords; ++k) {
    const auto measured = begin + std::chrono::duration_cast<Clock::duration>(
                                      std::chrono::duration<double>(k / (kNominal_Hz * kFactor)));
    std::this_thread::sleep_until(
        measured + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(wire_s)));
    daemon.line.write(text);
    true_s.push_back(std::chrono::duration<double>(measured.time_since_epoch()).count());
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  ASSERT_EQ(daemon.stop(SIGTERM), 0) << daemon.diagnostics();
  ASSERT_EQ(daemon.logs().size(), 1U);
  std::vector<std::string> logged;
  const Stamps stamps = replay(daemon.logs().front(), logged);
  ASSERT_EQ(stamps.validity_ns.size(), true_s.size());

  std::vector<double> errors_s;
  for (std::size_t k = 0; k < true_s.size(); ++k) {
    if (k > 0) {
      EXPECT_GT(stamps.validity_ns[k], stamps.validity_ns[k - 1]) << k;
    }
    if (k >= kLearning)
      errors_s.push_back(std::abs(static_cast<double>(stamps.validity_ns[k]) * 1e-9 - true_s[k]));
  }
  // A model that holds the device to its nominal rate lags by up to half a period, 25 ms.
  std::nth_element(errors_s.begin(), errors_s.begin() + errors_s.size() / 2, errors_s.end());
  EXPECT_LT(errors_s[errors_s.size() / 2], 6e-3);
  EXPECT_EQ(stamps.events, std::vector<std::string>{"clock.rate"});
  ASSERT_EQ(logged.size(), 1U);
  EXPECT_NE(logged[0].find("clock.rate"), std::string::npos) << logged[0];
}

}  // namespace
}  // namespace navcal::daemon
