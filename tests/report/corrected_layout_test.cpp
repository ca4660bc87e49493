// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "config/layout/layout_file.h"
#include "identify/answer/prediction.h"
#include "report/simulators/transfer.h"
#include "sim/layout/effects/layout_effects.h"
#include "tests/identify/identification_case.h"

namespace navcal::report {
namespace {

gap::Diagnosis found_in_an_rov() {
  gap::Diagnosis diagnosis;
  diagnosis.verdict = gap::Verdict::explained;
  diagnosis.effects = {{"thrust_scale", 0.99, {{"scale", -0.38, 0.02}}, {}, {}, "thruster.2"},
                       {"gyro_scale", 0.98, {{"scale_az", 0.03, 0.001}}, {}, {}, {}}};
  return diagnosis;
}

TEST(CorrectedLayout, IsNearerTheRecordingThanTheNominalOne) {
  const identify::VehicleCase of = identify::vehicle_case("rov");
  config::Layout truth =
      sim::changed_layout(of.prior, {sim::find_layout_effect("thrust_scale"), "thruster.2", {-0.4}});
  truth.uncertainties.clear();
  const SimulatorFile file = corrected_layout(found_in_an_rov(), "a.cap", of.prior);
  // After 10 s: after 1 s the noise of the measured starts is most of it.
  const auto velocity_error_m_s = [&](const config::Layout& layout) {
    identify::PredictionRequest request;
    request.layout = layout;
    request.recordings = {identify::draw_recording(of, truth, 60, 3, 0.05)};
    const auto found = identify::predict(request, [](double) {});
    return found.errors[1].velocity_m_s[static_cast<std::size_t>(identify::Predictor::layout)].value();
  };
  const double nominal = velocity_error_m_s(of.prior);
  EXPECT_LT(velocity_error_m_s(config::parse_layout(file.text, "c.toml")), 0.7 * nominal);
}

TEST(CorrectedLayout, SaysWhatItContainsAndWhatIsLeftOut) {
  const config::Layout layout = identify::vehicle_case("rov").prior;
  const SimulatorFile file = corrected_layout(found_in_an_rov(), "a.cap", layout);
  EXPECT_EQ(file.summary,
            "thrust_scale of thruster.2; left out: gyro_scale (an error of an instrument is no part of a layout)");
  EXPECT_NE(file.text.find("# Corrected: thrust_scale of thruster.2: probability 99.0 %; scale -0.380 +- 0.020."),
            std::string::npos)
      << file.text.substr(0, 600);
  gap::Diagnosis elsewhere = found_in_an_rov();
  elsewhere.effects[0].of = "thruster.20";
  EXPECT_NE(corrected_layout(elsewhere, "a.cap", layout).summary.find("left out: thrust_scale of thruster.20 ("),
            std::string::npos);
}

TEST(CorrectedLayout, WithoutACertainEffectItIsTheNominalOneAndSaysSo) {
  const config::Layout layout = identify::vehicle_case("rov").prior;
  gap::Diagnosis diagnosis = found_in_an_rov();
  diagnosis.verdict = gap::Verdict::no_gap;
  const SimulatorFile file = corrected_layout(diagnosis, "a.cap", layout);
  EXPECT_EQ(file.summary, "no correction: the verdict is no gap, and no effect is certain");
  EXPECT_EQ(config::parse_layout(file.text, "c.toml"),
            config::parse_layout(config::layout_file(layout), "n.toml"));
}

}  // namespace
}  // namespace navcal::report
