// SPDX-License-Identifier: Apache-2.0
#include "gap/nulls/backlash_null_bank.h"

#include <gtest/gtest.h>

#include "gap/inference/biases.h"
#include "gap/inference/spike_and_slab.h"
#include "tests/gap/simulated_mission.h"

namespace navcal::gap {
namespace {

TEST(BacklashNullBank, ShowsWhatABacklashLeavesBesideItself) {
  const config::VehicleSettings vehicle;
  const Library library({});
  std::size_t backlash = 0, gain = 0;
  for (std::size_t e = 0; e < library.size(); ++e) {
    if (library.is_backlash(e)) backlash = e;
    if (library[e].name == "fin_gain") gain = e;
  }
  EXPECT_TRUE(has_backlash(library, {gain, backlash}));
  EXPECT_FALSE(has_backlash(library, {gain}));
  EXPECT_FALSE(has_backlash(library, {}));

  // Without the orders, as of a host that recorded none, the reports alone tell where servos turned.
  Mission mission = test::simulated_mission("identification", "[fin_backlash]\nwidth_deg = 2\n", 150, 3);
  mission.order_times_s.clear();
  const Replay replay(mission, vehicle);
  const Eigen::VectorXd at = with_biases_found(replay, library, 2);
  Trajectory10Hz course;
  (void)replay.run(library.model(at), &course);
  const BankOptions options{20, 1, 2};
  const NullBank bank = make_null_bank({replay, course, vehicle}, library, at, options, [](double) {});
  const Priors priors = fit_spike_widths(library, bank.gram, bank.scores);
  const Linearised nominal = linearise({replay, library, bank.whitening, 2}, at);
  const ModelFit found = fit_model({backlash}, {{replay, library, bank.whitening, 2}, nominal, priors});
  const BacklashNullBank with_backlash =
      backlash_null_bank(found, {replay, course, vehicle}, {replay, library, bank.whitening}, options);
  ASSERT_GE(with_backlash.missions, 15);

  // The width, as the bank corrects it, is that of the vehicle.
  const Eigen::Index width = library.first(backlash);
  ModelFit corrected = found;
  correct(corrected, library, with_backlash);
  EXPECT_NEAR(corrected.mean[width], 2, 0.15);
  EXPECT_GE(corrected.std[width], found.std[width]);
  corrected.mean[width] = corrected.std[width] = 0;
  ModelFit as_it_was = found;
  as_it_was.mean[width] = as_it_was.std[width] = 0;
  EXPECT_EQ(corrected.mean, as_it_was.mean);
  EXPECT_EQ(corrected.std, as_it_was.std);
  EXPECT_GT(with_backlash.scatter[width], 0);
  EXPECT_LT(with_backlash.scatter[width], 0.2);
  EXPECT_EQ(with_backlash.excess.cwiseAbs().sum(), std::abs(with_backlash.excess[width]));

  // The reports do not tell where the fins stand in the dead band: more is left than of vehicles without.
  const auto left = [](const RegimeStatistics& statistics, std::string_view channel) {
    double sum = 0;
    for (std::size_t c = 0; c < reported_channels().size(); ++c) {
      if (reported_channels()[c].name == channel)
        sum = statistics.mean_square.row(static_cast<Eigen::Index>(c)).sum();
    }
    return sum;
  };
  for (const auto channel : {"vehicle.pitch_rate", "vehicle.yaw_rate"}) {
    EXPECT_GT(left(with_backlash.explained_rms, channel), left(bank.explained_rms, channel)) << channel;
  }
  const Priors wider = widened(priors, library, found, with_backlash);
  EXPECT_TRUE((wider.spike.array() >= priors.spike.array()).all());
  EXPECT_GT((wider.spike - priors.spike).sum(), 0);
}

}  // namespace
}  // namespace navcal::gap
