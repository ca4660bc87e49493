// SPDX-License-Identifier: Apache-2.0
// A mission with calibrators, live into a log and back out of it: the same samples to the last bit, through orders
// of the operator and through a change of the log file.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "config/load.h"
#include "pipeline/pipeline.h"
#include "protocols/imu_card.h"
#include "record/json/calibration_json.h"
#include "record/json/message_json.h"
#include "record/recording.h"
#include "tests/record/temporary_folder.h"

namespace navcal::record {
namespace {

constexpr std::int64_t kMs = 1'000'000;
constexpr std::int64_t kStart_ns = 50'000 * kMs;
constexpr double kDegrees = 180 / std::numbers::pi;

config::Settings compass_and_imu() {
  config::Settings settings;
  settings.ports.push_back(config::default_port("compass", protocols::Protocol::tcm2, 38400));
  settings.ports.push_back(config::default_port("imu", protocols::Protocol::imu_card, 57600));
  settings.ports[0].path = "/dev/ttyS0";
  settings.ports[1].path = "/dev/ttyS1";
  return settings;
}

struct Read {
  std::uint16_t port = 0;
  std::int64_t arrival_ns = 0;
  std::vector<std::uint8_t> bytes;
};

std::string word(double heading_rad, double hard_iron_uT, std::mt19937_64& random) {
  std::normal_distribution<double> noise(0, 0.15);
  const double x = 19 * std::cos(heading_rad) + hard_iron_uT + noise(random);
  const double y = -19 * std::sin(heading_rad) + noise(random);
  const double shown_deg = std::fmod(std::atan2(-y, x) * kDegrees + 360, 360.0);
  const std::string body =
      fmt::format("C{:.1f}P0.0R0.0X{:.2f}Y{:.2f}Z{:.2f}T20.0", shown_deg, x, y, 44 + noise(random));
  unsigned char sum = 0;
  for (const char c : body) sum = static_cast<unsigned char>(sum ^ static_cast<unsigned char>(c));
  return fmt::format("${}*{:02X}\r\n", body, sum);
}

/// A compass with hard iron and a biased gyro on a vehicle that turns at a changing rate.
std::vector<Read> mission(int seconds) {
  std::mt19937_64 random(11);
  std::normal_distribution<double> rate_noise(0, 0.1);
  std::vector<Read> reads;
  double heading_rad = 0;
  for (int i = 0; i < seconds * 20; ++i) {
    const std::int64_t at_ns = kStart_ns + i * 50 * kMs;
    const double rate_rad_s = 0.35 + 0.25 * std::sin(i * 0.05 * 0.21);
    heading_rad += rate_rad_s * 0.05;
    protocols::imu_card::Record record;
    record.sequence = static_cast<std::uint8_t>(i);
    record.raw.fill(2048 * 16);
    const double measured_deg_s = (rate_rad_s * kDegrees + 1.5) / 1.05 + rate_noise(random);
    record.raw[1] = static_cast<std::uint16_t>((2048 + 10 * measured_deg_s) * 16);
    record.raw[3] = static_cast<std::uint16_t>((2048 + 10 * (rate_rad_s * kDegrees + rate_noise(random))) * 16);
    record.raw[6] = (2048 - 1000) * 16;
    const auto frame = protocols::imu_card::encode_record(record);
    reads.push_back({1, at_ns + 29 * kMs, {frame.begin(), frame.end()}});
    if (i % 2 != 0) continue;
    const std::string text = word(heading_rad, 4, random);
    reads.push_back({0, at_ns + 64 * kMs, {text.begin(), text.end()}});
  }
  std::stable_sort(reads.begin(), reads.end(),
                   [](const Read& a, const Read& b) { return a.arrival_ns < b.arrival_ns; });
  return reads;
}

/// Samples as lines; what is told of calibrations goes to `calibration`.
struct Lines : pipeline::Sink {
  void on_sample(const instruments::Sample& sample) override {
    append_json(lines.emplace_back(), sample, sample.port == 0 ? "compass" : "imu");
  }
  void on_calibration(const pipeline::CalibrationChange& change) override {
    changes.push_back(change);
    if (calibration) calibration(change);
  }
  std::vector<std::string> lines;
  std::vector<pipeline::CalibrationChange> changes;
  std::function<void(const pipeline::CalibrationChange&)> calibration;
};

void replay(Recording& recording, pipeline::Pipeline& pipeline, Lines& lines) {
  while (const auto entry = recording.next()) {
    if (const auto* raw = std::get_if<RawRead>(&*entry)) {
      pipeline.bytes(raw->port, raw->time_ns, raw->bytes, lines);
    } else if (const auto* change = std::get_if<MappingChange>(&*entry)) {
      pipeline.set_mapping(change->mapping, lines);
    } else if (const auto* calibration = std::get_if<pipeline::CalibrationChange>(&*entry)) {
      EXPECT_EQ(pipeline.replay_calibration(*calibration, lines), "");
    }
  }
}

class CalibrationReplay : public testing::TemporaryFolder {
 protected:
  CalibrationReplay() : pipeline_(compass_and_imu()) {
    live_.calibration = [this](const pipeline::CalibrationChange& change) { log(change); };
  }

  void log(const pipeline::CalibrationChange& change) {
    std::string json;
    append_json(json, pipeline_.mapping(), change);
    encoder_.calib(file_, change.time_ns, json);
  }
  void begin_file(std::int64_t now_ns) {
    pipeline_.advance(now_ns, live_);
    file_.clear();
    encoder_.begin(file_, now_ns, pipeline_.mapping());
    log(pipeline_.calibration_beginning(now_ns));
  }
  std::filesystem::path end_file(const std::string& name, std::int64_t now_ns) {
    encoder_.finish(file_, now_ns);
    return write(name, file_);
  }
  /// The mission of `seconds`; `at(second)` is called as each begins.
  void run(int seconds, const std::function<void(int second, std::int64_t now_ns)>& at) {
    int second = -1;
    for (const Read& read : mission(seconds)) {
      if (const int now = static_cast<int>((read.arrival_ns - kStart_ns) / (1000 * kMs)); now != second) {
        second = now;
        at(second, read.arrival_ns - kMs);
      }
      encoder_.raw(file_, read.port, Direction::received, read.arrival_ns, read.bytes);
      pipeline_.bytes(read.port, read.arrival_ns, read.bytes, live_);
    }
  }
  std::string order(pipeline::CalibrationOrder order, calib::Calibrator calibrator, std::int64_t now_ns) {
    return pipeline_.order_calibration(order, calibrator, now_ns, live_);
  }

  pipeline::Pipeline pipeline_;
  LogEncoder encoder_{compass_and_imu(), config::to_toml(compass_and_imu())};
  std::string file_;
  Lines live_;
};

using calib::Calibrator;
using pipeline::CalibrationOrder;

TEST_F(CalibrationReplay, GivesWhatWasLiveThroughOrdersAndAChangeOfFile) {
  std::filesystem::path first;
  std::size_t lines_in_first = 0;
  std::string name_at_change;
  begin_file(kStart_ns);
  run(150, [&](int second, std::int64_t now_ns) {
    if (second == 80) {
      EXPECT_EQ(order(CalibrationOrder::accept, Calibrator::gyro, now_ns), "");
    } else if (second == 90) {
      EXPECT_EQ(order(CalibrationOrder::roll_back, Calibrator::gyro, now_ns), "");
    } else if (second == 95) {
      EXPECT_EQ(order(CalibrationOrder::start, Calibrator::gyro_b, now_ns), "");
    } else if (second == 100) {
      first = end_file("a.mcap", now_ns);
      begin_file(now_ns);
      lines_in_first = live_.lines.size();
      name_at_change = pipeline_.calibration_report().name.text();
    }
  });
  const auto second = end_file("b.mcap", kStart_ns + 150'000 * kMs);
  const auto automatic = [](const pipeline::CalibrationChange& change) {
    return change.cause == pipeline::CalibrationChange::Cause::automatic;
  };
  ASSERT_TRUE(std::any_of(live_.changes.begin(), live_.changes.end(), automatic));
  EXPECT_NE(live_.lines.back().find("\"calibration\":\""), std::string::npos) << live_.lines.back();

  Lines replayed;
  const auto recording = Recording::open(first);
  pipeline::Pipeline again(recording->settings());
  replay(*recording, again, replayed);
  replay(*Recording::open(second), again, replayed);
  ASSERT_EQ(replayed.lines.size(), live_.lines.size());
  for (std::size_t i = 0; i < live_.lines.size(); ++i) ASSERT_EQ(replayed.lines[i], live_.lines[i]) << i;
  EXPECT_EQ(calib_lines(again.calibration_report(), {}), calib_lines(pipeline_.calibration_report(), {}));

  // The second file alone goes on from the calibration recorded in it.
  Lines alone;
  pipeline::Pipeline fresh(recording->settings());
  replay(*Recording::open(second), fresh, alone);
  ASSERT_FALSE(alone.lines.empty());
  EXPECT_NE(alone.lines.front().find(name_at_change), std::string::npos) << alone.lines.front();
  EXPECT_LT(alone.lines.size(), live_.lines.size() - lines_in_first + 2);
  EXPECT_GT(fresh.calibration_report().find(Calibrator::gyro)->judgement.samples, 1000U)
      << "what the estimators had learnt is in the file, too";
}

TEST_F(CalibrationReplay, ALogOfAnotherVersionBeginsAnewAndSaysSo) {
  pipeline::CalibrationChange change;
  change.state = "not a state";
  Lines lines;
  EXPECT_NE(pipeline_.replay_calibration(change, lines), "");
  EXPECT_EQ(pipeline_.calibration_report().name.number, 0U);
}

TEST_F(CalibrationReplay, AStateCutAnywhereChangesNothing) {
  begin_file(kStart_ns);
  run(20, [](int, std::int64_t) {});
  const auto state = pipeline_.calibration_beginning(kStart_ns + 30'000 * kMs).state;
  std::mt19937 random(3);
  for (int i = 0; i < 50; ++i) {
    EXPECT_FALSE(pipeline_.restore_calibration(std::string_view(state).substr(0, random() % state.size())));
  }
  EXPECT_EQ(pipeline_.calibration_beginning(kStart_ns + 30'000 * kMs).state, state);
}

}  // namespace
}  // namespace navcal::record
