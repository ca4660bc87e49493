// SPDX-License-Identifier: Apache-2.0
// The table of eight headings, against the calibrated gyro.
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "calib/suite/calibrator_unit.h"
#include "calib/swing/swing.h"

namespace navcal::calib {
namespace {

constexpr std::array<std::string_view, Swing::kHeadings> kSwingHeadings{"N_rad", "NE_rad", "E_rad", "SE_rad",
                                                                        "S_rad", "SW_rad", "W_rad", "NW_rad"};

/// The reference is the calibrated gyro, begun at the compass's own heading: the deviations are right but for a
/// constant, which is A.
class SwingUnit : public CalibratorUnit {
 public:
  SwingUnit(const SuiteOptions&, SharedEstimators&) {}
  void update_learnt(const LearntReading& learnt) override {
    if (!swing_ || !learnt.turn || !learnt.gyro) return;
    const TurnStep& turn = *learnt.turn;
    if (!anchored_) {
      reference_rad_ = turn.heading_rad;
    } else if (turn.begins_segment) {
      // The compass itself is the only source for the turn across a gap.
      reference_rad_ += std::remainder(turn.heading_rad - heading_rad_, 2 * std::numbers::pi);
    } else {
      reference_rad_ += learnt.gyro->scale * turn.measured_angle_rad + learnt.gyro->bias_rad_s * turn.bias_time_s +
                        turn.tilt_angle_rad;
    }
    anchored_ = true;
    heading_rad_ = turn.heading_rad;
    swing_->update(turn.time_s, turn.heading_rad, reference_rad_);
  }
  void start() override {
    swing_.emplace();
    anchored_ = false;
  }
  void put_estimate(Correction& into) const override {
    into.swing.reset();
    const auto table_rad = swing_ ? swing_->table_rad() : std::nullopt;
    if (!table_rad) return;
    // The gyro gives no absolute heading, so the mean of the eight deviations is A, which a swing cannot
    // determine.
    SwingCorrection correction{*table_rad};
    const double mean_rad = std::accumulate(table_rad->begin(), table_rad->end(), 0.0) / Swing::kHeadings;
    for (double& deviation_rad : correction.deviation_rad) deviation_rad -= mean_rad;
    into.swing = correction;
  }
  [[nodiscard]] Judgement judgement() const override {
    if (swing_) return swing_->judgement();
    Judgement judgement;
    judgement.reason = "not begun";
    judgement.manoeuvre = "give calibration.start for swing, then rest on each of the eight headings";
    return judgement;
  }
  [[nodiscard]] std::vector<Quantity> quantities() const override {
    std::vector<Quantity> quantities;
    if (!swing_) return quantities;
    const auto headings = swing_->headings();
    for (std::size_t i = 0; i < headings.size(); ++i) {
      if (headings[i].rests > 0)
        quantities.push_back({kSwingHeadings[i], headings[i].deviation_rad, headings[i].std_rad});
    }
    return quantities;
  }
  void archive(Archive& archive) override { archive(swing_, reference_rad_, heading_rad_, anchored_); }

 private:
  std::optional<Swing> swing_;  ///< begun by the operator
  double reference_rad_ = 0, heading_rad_ = 0;
  bool anchored_ = false;
};

std::vector<NamedNumbers> values_of_swing(const SwingCorrection& swing) {
  return {{"deviation_rad", {swing.deviation_rad.begin(), swing.deviation_rad.end()}, 1}};
}

}  // namespace

namespace calibrator_rows {
extern const CalibratorRow swing;
constinit const CalibratorRow swing{
    .name = "swing",
    .title = "Eight headings",
    .needs = {.compass = true, .rate = true},
    .needs_text = "a compass and an inertial card (protocol imu-card)",
    .corrects = Corrects::heading,
    .by_order = true,
    .place = place_of<&Correction::swing>(),
    .values = [](const Correction& correction) { return values_of_swing(*correction.swing); },
    .make = make_unit<SwingUnit>};
}  // namespace calibrator_rows
}  // namespace navcal::calib
