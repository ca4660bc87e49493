// SPDX-License-Identifier: Apache-2.0
// --place, --date and --field of the simulator: what the recording then says.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <fstream>
#include <numbers>

#include "base/world_magnetic_model.h"
#include "gap/data/mission.h"
#include "pipeline/pipeline.h"
#include "record/recording.h"
#include "tests/cli/command_outcome.h"
#include "tests/support/temporary_folder.h"

namespace navcal::cli {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;

/// Sums of what the instruments of a recording said.
struct Said final : pipeline::Sink {
  double fixes = 0, latitude_deg = 0, longitude_deg = 0, words = 0, field_uT = 0;
  std::int64_t first_ns = 0;

  void on_sample(const instruments::Sample& sample) override {
    if (const auto* gps = std::get_if<instruments::GpsSample>(&sample.value);
        gps != nullptr && gps->latitude_rad) {
      if (fixes == 0) first_ns = sample.stamp.validity_ns;
      fixes += 1;
      latitude_deg += *gps->latitude_rad * kDegrees;
      longitude_deg += *gps->longitude_rad * kDegrees;
    }
    if (const auto* compass = std::get_if<instruments::CompassSample>(&sample.value);
        compass != nullptr && compass->field_body_uT) {
      const auto [x, y, z] = *compass->field_body_uT;
      words += 1;
      field_uT += std::hypot(x, y, z);
    }
  }
};

struct Place : testing::Test {
  navcal::test::TemporaryFolder folder;

  test::Outcome simulate(std::vector<std::string> options) const {
    options.insert(options.begin(), {"simulate", "--path", NAVCAL_SOURCE_DIR "/fixtures/paths/path3.csv", "-o",
                                     (folder / "a.cap").string()});
    return test::run_command(add_simulate, std::move(options));
  }
  [[nodiscard]] Said said() const {
    const auto recording = record::Recording::open(folder / "a.cap");
    pipeline::Pipeline pipeline(gap::samples_only(recording->settings()));
    Said all;
    while (const auto entry = recording->next()) {
      const auto* raw = std::get_if<record::RawRead>(&*entry);
      if (raw != nullptr && raw->direction == record::Direction::received) {
        pipeline.bytes(raw->port, raw->time_ns, raw->bytes, all);
      }
    }
    return all;
  }
  [[nodiscard]] std::string capture() const { return navcal::test::read_file(folder / "a.cap"); }
};

TEST_F(Place, FixesFieldAndTimeAreThoseAsked) {
  const auto outcome = simulate({"--place", "78.22,15.63,3", "--date", "2027-03-01"});
  ASSERT_EQ(outcome.status, 0) << outcome.message;
  const Said all = said();
  ASSERT_GT(all.fixes, 5);
  EXPECT_NEAR(all.latitude_deg / all.fixes, 78.22, 0.001);
  EXPECT_NEAR(all.longitude_deg / all.fixes, 15.63, 0.003);
  EXPECT_EQ(all.first_ns / 86'400'000'000'000, 1'803'859'200 / 86'400);  // 2027-03-01
  const auto there = base::world_magnetic_field({78.22 / kDegrees, 15.63 / kDegrees, 3}, 2027.0 + 59.0 / 365);
  EXPECT_NEAR(all.field_uT / all.words, there.total_uT(), 0.05);
  EXPECT_NE(capture().find("\n#event simulated field of the Earth: north "), std::string::npos);
}

TEST_F(Place, AFieldByHandNeedsNoPlace) {
  const auto outcome = simulate({"--field", "-5,3,-30"});
  ASSERT_EQ(outcome.status, 0) << outcome.message;
  const Said all = said();
  EXPECT_NEAR(all.field_uT / all.words, std::hypot(5, 3, 30), 0.05);
  EXPECT_NEAR(all.latitude_deg / all.fixes, 37.0629, 0.001);
  EXPECT_NE(capture().find("field of the Earth: north -5.000, east 3.000, down -30.000 uT\n"), std::string::npos);
}

TEST_F(Place, AcrossTheMeridianOf180LongitudesStayWithin180) {
  ASSERT_EQ(simulate({"--place", "-16.8,179.99999"}).status, 0);
  const Said all = said();
  EXPECT_LE(std::abs(all.longitude_deg / all.fixes), 180);
  EXPECT_NEAR(all.latitude_deg / all.fixes, -16.8, 0.001);
}

TEST_F(Place, WithoutThemTheReferenceFieldIsStated) {
  ASSERT_EQ(simulate({}).status, 0);
  EXPECT_NE(capture().find("field of the Earth: north 19.000, east 0.600, down 44.000 uT\n"), std::string::npos);
  const Said all = said();
  EXPECT_NEAR(all.field_uT / all.words, std::hypot(19.0, 0.6, 44.0), 0.05);
  EXPECT_EQ(all.first_ns / 86'400'000'000'000, 1'767'225'600 / 86'400);
}

TEST_F(Place, WhatIsNoPlaceDayOrFieldIsRefused) {
  using Options = std::vector<std::string>;
  for (const auto& options :
       {Options{"--place", "91,0"}, Options{"--place", "89.5,0"}, Options{"--place", "north"},
        Options{"--place", "1,2,nan"}, Options{"--date", "2026-02-30"}, Options{"--field", "1,2"},
        Options{"--field", "0,0,0"}, Options{"--field", "nan,0,40"}, Options{"--field", "1,2,300"}}) {
    const auto outcome = simulate(options);
    EXPECT_EQ(outcome.status, 2) << options.back();
    EXPECT_NE(outcome.message.find(options.front()), std::string::npos) << outcome.message;
  }
}

}  // namespace
}  // namespace navcal::cli
