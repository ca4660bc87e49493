// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <fstream>

#include "analysis/calibrate_run.h"
#include "record/recording.h"
#include "tests/cli/calibrate_command.h"
#include "tests/cli/simulated_recording.h"
#include "tests/report/markup.h"

namespace navcal::cli::test {
namespace {

class CalibrateReport : public CalibrateCommand {
 protected:
  std::string page_of(const std::string& capture) {
    const auto page = folder_ / "page.html";
    const Outcome outcome = run({"--report", page.string(), write("a.cap", capture)});
    EXPECT_EQ(outcome.status, 0) << outcome.message;
    EXPECT_NE(outcome.output, "") << "the answer comes as without";
    return navcal::test::read_file(page);
  }
};

TEST_F(CalibrateReport, IsWholeAndHasEveryPicture) {
  RecordingOptions options;
  options.duration_s = 120;
  options.offset_uT = {4, -3, 2};
  const std::string page = page_of(simulated_recording(turning_path(120), options));
  EXPECT_EQ(flaw_in(page), "");
  EXPECT_LT(page.size(), 500'000U);
  for (const char* picture : {"Deviation of the compass", "Heading against the gyro", "Headings visited",
                              "Field as measured", "Field calibrated", "Size of the field", "Gyros: scale",
                              "Gyros: bias", "Compass deviation", "Magnetometer: offset"}) {
    EXPECT_EQ(count(page, "<title>" + std::string(picture) + "</title>"), 1) << picture;
  }
  for (const char* said :
       {"two standard errors", "fitted ellipse", "Compass shows, deg", "Readings left out", "Estimates", "a.cap",
        "navcal " NAVCAL_VERSION, "prefers-color-scheme: dark", "@media print"}) {
    EXPECT_NE(page.find(said), std::string::npos) << said;
  }
  EXPECT_EQ(page.find("nan"), std::string::npos);
}

TEST_F(CalibrateReport, ALongRecordingMakesNoLongPage) {
  RecordingOptions options;
  options.duration_s = 1500;
  options.gps = options.motor = false;
  EXPECT_LT(page_of(simulated_recording(turning_path(1500), options)).size(), 500'000U);
}

TEST_F(CalibrateReport, WhatCannotBeShownIsSaid) {
  RecordingOptions options;
  options.duration_s = 20;
  const std::string straight = page_of(simulated_recording(straight_path(20), options));
  EXPECT_EQ(flaw_in(straight), "");
  EXPECT_NE(straight.find("The heading has no reference"), std::string::npos);
  options.compass = false;
  const std::string no_compass = page_of(simulated_recording(straight_path(20), options));
  EXPECT_EQ(flaw_in(no_compass), "");
  const std::string nothing = page_of("#capture 1\n#port imu imu-card 57600\n");
  EXPECT_EQ(flaw_in(nothing), "");
  EXPECT_NE(nothing.find("no compass"), std::string::npos);
  EXPECT_EQ(no_compass.find("No readings came"), std::string::npos) << "those of the card came";
}

TEST_F(CalibrateReport, CurvesEndAtTheEstimatesOfTheReport) {
  for (const double duration_s : {33.0, 120.0}) {
    RecordingOptions options;
    options.duration_s = duration_s;
    const auto capture = write("a.cap", simulated_recording(turning_path(duration_s), options));
    const auto settings = record::Recording::open(capture)->settings();
    analysis::CalibrateHistory history(settings);
    analysis::CalibrateRun run(settings, &history);
    run.play(capture);
    const calib::Report report = run.finish();
    for (const auto& calibrator : report.calibrators) {
      for (const auto& quantity : calibrator.estimate) {
        const std::string name =
            std::string(calib::name_of(calibrator.calibrator)) + "." + std::string(quantity.name);
        const auto found = history.estimates().find(name);
        ASSERT_NE(found, history.estimates().end()) << name;
        if (std::isfinite(quantity.value)) {
          EXPECT_EQ(found->second.back().value, quantity.value) << name;
        }
      }
    }
  }
}

TEST_F(CalibrateReport, APictureWithoutDataIsLeftOutWithAWord) {
  // No heading, field only: words without C.
  const std::string page = page_of("#capture 1\n#port compass tcm2 38400\n");
  EXPECT_EQ(flaw_in(page), "");
  EXPECT_EQ(page.find("Headings seen</h3>"), std::string::npos);
  EXPECT_NE(page.find("No headings in the recording"), std::string::npos);
}

TEST_F(CalibrateReport, TheFieldHasOneFigure) {
  RecordingOptions options;
  options.duration_s = 120;
  options.offset_uT = {4, -3, 2};
  const std::string page = page_of(simulated_recording(turning_path(120), options));
  const std::string row = "<td>field</td><td>";
  const std::size_t at = page.find(row);
  ASSERT_NE(at, std::string::npos);
  const std::size_t begin = at + row.size();
  const std::string field = page.substr(begin, page.find('<', begin) - begin);
  EXPECT_NE(page.find("field " + field + " uT. N, E, S, W"), std::string::npos) << field;
}

TEST_F(CalibrateReport, AFailureLeavesNoHalfOfIt) {
  RecordingOptions options;
  options.duration_s = 10;
  const auto good = write("a.cap", simulated_recording(straight_path(10), options));
  const auto bad = write("b.cap", "#capture 1\n#port imu imu-card 57600\nx\n");
  const auto page = folder_ / "page.html";
  EXPECT_EQ(run({"--report", page.string(), good, bad}).status, 3);
  EXPECT_FALSE(std::filesystem::exists(page));
  EXPECT_FALSE(std::filesystem::exists(page.string() + ".part"));
  write("page.html", "the one before");
  EXPECT_EQ(run({"--report", page.string(), bad}).status, 3);
  EXPECT_EQ(navcal::test::read_file(page), "the one before");
}

TEST_F(CalibrateReport, AFolderThatIsNotThereIsToldBeforeTheWork) {
  const auto page = (folder_ / "absent" / "page.html").string();
  const Outcome outcome = run({"--report", page, write("a.cap", "not looked at")});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_EQ(outcome.message.find(page), 0U) << outcome.message;
}

}  // namespace
}  // namespace navcal::cli::test
