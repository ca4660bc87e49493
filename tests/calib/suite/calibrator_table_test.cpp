// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "calib/suite/estimators.h"
#include "calib/suite/in_force.h"
#include "tests/calib/suite/mean_pitch.h"
#include "tests/calib/suite/suite_drive.h"
#include "tests/calib/thesis_paths.h"

namespace navcal::calib {
namespace {

using namespace test;

std::string saved_unit(CalibratorUnit& unit) {
  Archive archive;
  unit.archive(archive);
  return archive.bytes();
}

/// Every unit has been given readings of all instruments.
void feed(Suite& suite) {
  std::size_t i = 0;
  for (const Reading& reading : readings_along("path5", thesis_deviation(), {}, 7)) {
    Reading one = reading;
    if (auto* compass = std::get_if<CompassReading>(&one))
      compass->field_body_uT = {19 * std::cos(0.01 * static_cast<double>(i)),
                                3 + 0.01 * static_cast<double>(i % 7), 44};
    suite.put(one);
    const double t = time_of(one);
    if (++i % 10 == 0) suite.put(GroundReading{t, {t, 0.5 * t}, 1.1, 0.4});
    if (i % 10 == 5)
      suite.put(MotorReading{t, 600 + static_cast<double>(i % 100), 2 + 0.01 * static_cast<double>(i)});
  }
}

TEST(CalibratorTable, TheNamedOnesAreTheFirstInTheOrderOfTheirNumbers) {
  const std::array<std::string_view, kNamedCalibrators> names{
      "gyro",  "gyro_b",       "compass",       "magnetometer", "gps_compass",
      "swing", "misalignment", "compass_delay", "course_delay", "motor_current"};
  ASSERT_GE(calibrators().size(), names.size());
  for (std::size_t i = 0; i < names.size(); ++i) {
    EXPECT_EQ(name_of(static_cast<Calibrator>(i)), names[i]);
    EXPECT_EQ(calibrator_named(names[i]), static_cast<Calibrator>(i));
  }
  EXPECT_FALSE(calibrator_named("sextant"));
}

TEST(CalibratorTable, EveryRowIsComplete) {
  std::set<std::string_view> names, titles;
  for (const Calibrator calibrator : calibrators()) {
    const CalibratorRow& row = row_of(calibrator);
    EXPECT_TRUE(names.insert(row.name).second) << row.name;
    EXPECT_TRUE(titles.insert(row.title).second) << row.title;
    EXPECT_LT(row.title.size(), 21U) << "wider than its column of the text";
    EXPECT_FALSE(row.needs_text.empty()) << row.name;
    EXPECT_TRUE(row.needs.compass) << row.name;
    EXPECT_NE(row.make, nullptr) << row.name;
    EXPECT_TRUE(row.values != nullptr || !row.value_names.empty()) << row.name;
  }
}

TEST(CalibratorTable, EachValueIsCopiedAloneAndSaysItsNumbers) {
  Correction full;
  full.gyro = full.gyro_b = RateCorrection{1.1, 0.2};
  full.compass = full.gps_compass = DeviationCorrection{{1, 2, 3, 4, 5}};
  full.magnetometer = FieldCorrection{};
  full.swing = SwingCorrection{};
  full.misalignment_rad = 0.1;
  full.compass_delay_s = full.course_delay_s = 0.2;
  full.motor_current = MotorCurrentCorrection{};
  const std::array<double, 5> deviation{1, 2, 3, 4, 5};
  for (const Calibrator calibrator : calibrators().subspan(kNamedCalibrators))
    full.added.set(calibrator, deviation);
  for (const Calibrator calibrator : calibrators()) {
    Correction one;
    EXPECT_TRUE(values_of(one, calibrator).empty());
    copy_value(one, full, calibrator);
    for (const Calibrator other : calibrators()) EXPECT_EQ(has(one, other), other == calibrator) << name_of(other);
    const auto values = values_of(one, calibrator);
    EXPECT_FALSE(values.empty()) << name_of(calibrator);
    for (const NamedNumbers& numbers : values) {
      EXPECT_FALSE(numbers.values.empty());
      EXPECT_EQ(numbers.values.size() % std::max<std::size_t>(numbers.rows, 1), 0U);
    }
    if (calibrator == Calibrator::magnetometer) {
      ASSERT_EQ(values.size(), 2U);
      EXPECT_EQ(values[0].rows, 1U) << "the offset is a row";
      EXPECT_EQ(values[1].rows, 3U);
    }
    copy_value(one, Correction{}, calibrator);
    EXPECT_FALSE(has(one, calibrator));
  }
}

TEST(CalibratorUnits, WithoutReadingsEachIsRefusedWithAReason) {
  Suite suite(thesis_options(), kEveryInstrument);
  const Report report = suite.report();
  ASSERT_EQ(report.calibrators.size(), calibrators().size());
  for (const CalibratorReport& one : report.calibrators) {
    EXPECT_EQ(name_of(one.verdict), "refused") << name_of(one.calibrator);
    EXPECT_FALSE(one.judgement.reason.empty()) << name_of(one.calibrator);
    EXPECT_FALSE(has(report.estimates, one.calibrator)) << name_of(one.calibrator);
  }
}

TEST(CalibratorUnits, EachIsSavedAndRestoredExactly) {
  const ScopedCalibrator added(kMeanPitch);
  Suite suite(thesis_options(), kEveryInstrument);
  feed(suite);
  const std::string state = saved(suite);
  Suite other = restored(state, thesis_options(), kEveryInstrument);
  EXPECT_EQ(saved(other), state);
  const Report before = suite.report(), after = other.report();
  for (std::size_t i = 0; i < before.calibrators.size(); ++i) {
    const auto &one = before.calibrators[i], &same = after.calibrators[i];
    EXPECT_EQ(one.judgement.reason, same.judgement.reason);
    ASSERT_EQ(one.estimate.size(), same.estimate.size()) << name_of(one.calibrator);
    for (std::size_t k = 0; k < one.estimate.size(); ++k) {
      EXPECT_EQ(one.estimate[k].name, same.estimate[k].name);
      EXPECT_TRUE(one.estimate[k].value == same.estimate[k].value || std::isnan(one.estimate[k].value));
    }
  }
}

TEST(CalibratorUnits, EachUnitThatHasAStateSavesItByItself) {
  const ScopedCalibrator added(kMeanPitch);
  const SuiteOptions options = thesis_options();
  Estimators fed(options);
  double t = 0;
  for (const Reading& reading : readings_along("path2", thesis_deviation(), {}, 1)) {
    if (const auto* compass = std::get_if<CompassReading>(&reading)) fed.update(*compass, {});
    if (const auto* rate = std::get_if<RateReading>(&reading)) fed.update(*rate);
    t = time_of(reading);
    while (fed.next({})) {
    }
  }
  fed.update(MotorReading{t, 600, 2.0}, {});
  for (const Calibrator calibrator : calibrators()) {
    Estimators other(options);
    const std::string state = saved_unit(fed.unit(calibrator));
    Archive restoring{std::string_view(state)};
    other.unit(calibrator).archive(restoring);
    EXPECT_TRUE(restoring.ok() && restoring.at_end()) << name_of(calibrator);
    EXPECT_EQ(saved_unit(other.unit(calibrator)), state) << name_of(calibrator);
    EXPECT_EQ(other.unit(calibrator).judgement().reason, fed.unit(calibrator).judgement().reason)
        << name_of(calibrator);
  }
}

TEST(AddedCalibrator, AStateFromBeforeItIsReadAndOneWithItIsRefusedWithoutIt) {
  Suite old(thesis_options(), kEveryInstrument);
  feed(old);
  const std::string before = saved(old);
  std::string with;
  {
    const ScopedCalibrator added(kMeanPitch);
    Suite suite(thesis_options(), kEveryInstrument);
    feed(suite);  // to be forgotten
    Archive restoring{std::string_view(before)};
    suite.archive(restoring);
    ASSERT_TRUE(restoring.ok() && restoring.at_end());
    EXPECT_EQ(suite.report().find(*calibrator_named("mean_pitch"))->judgement.reason,
              "too few readings of the pitch");
    EXPECT_EQ(suite.in_force().name(), old.in_force().name());
    with = saved(suite);
  }
  Suite without(thesis_options(), kEveryInstrument);
  Archive restoring{std::string_view(with)};
  without.archive(restoring);
  EXPECT_FALSE(restoring.ok());
}

TEST(AddedCalibrator, ItsValueHasAPlaceInTheHistoryOfChanges) {
  const ScopedCalibrator added(kMeanPitch);
  const Calibrator mean_pitch = *calibrator_named("mean_pitch");
  Correction value;
  value.added.set(mean_pitch, std::array{0.25});
  InForce in_force;
  in_force.adopt(mean_pitch, value);
  Correction gyro;
  gyro.gyro = RateCorrection{1.1, 0};
  in_force.adopt(Calibrator::gyro, gyro);
  Archive saving;
  in_force.archive(saving);
  InForce back;
  Archive restoring{std::string_view(saving.bytes())};
  back.archive(restoring);
  ASSERT_TRUE(restoring.ok() && restoring.at_end());
  EXPECT_EQ(back.name(), in_force.name());
  EXPECT_TRUE(has(back.correction(), mean_pitch));
  CompassReading reading;
  reading.heading_rad = 1;
  EXPECT_DOUBLE_EQ(*corrected_heading(back.correction(), reading), 0.75);
  EXPECT_TRUE(back.roll_back(mean_pitch));
  EXPECT_FALSE(has(back.correction(), mean_pitch));
  EXPECT_FALSE(corrected_heading(back.correction(), reading));
}

}  // namespace
}  // namespace navcal::calib
