// SPDX-License-Identifier: Apache-2.0
// Innovations of a recording of the reference vehicle, and by how much each effect on the vehicle changes them, as
// they were when this was written: a change of its equations or of the replay shows here.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "gap/inference/biases.h"
#include "gap/inference/library.h"
#include "gap/replay/replay.h"
#include "tests/gap/simulated_mission.h"

namespace navcal::gap {
namespace {

/// Root of the mean square of what is finite, channel by channel.
std::vector<double> rms_of(const Eigen::MatrixXd& grid) {
  std::vector<double> all;
  for (Eigen::Index c = 0; c < grid.cols(); ++c) {
    double square = 0;
    int count = 0;
    for (Eigen::Index i = 0; i < grid.rows(); ++i) {
      if (!std::isfinite(grid(i, c))) continue;
      square += grid(i, c) * grid(i, c);
      ++count;
    }
    all.push_back(std::sqrt(square / count));
  }
  return all;
}

void expect_same(const std::vector<double>& found, const std::vector<double>& wanted, const std::string& of) {
  EXPECT_EQ(found.size(), wanted.size());
  bool same = found.size() == wanted.size();
  for (std::size_t i = 0; same && i < found.size(); ++i) same = std::abs(found[i] / wanted[i] - 1) < 1e-6;
  EXPECT_TRUE(same) << of << fmt::format(" is now {:.9g}", fmt::join(found, ", "));
}

TEST(GoldenReplay, InnovationsAreWhatTheyWere) {
  const Mission mission = test::simulated_mission(
      "identification", "[fin_gain]\nscale = 0.1\n[thrust_scale]\nscale = -0.1\n[hard_iron]\nx_uT = 2\n", 90, 9);
  const Replay replay(mission, {});
  const Library library({});
  const Eigen::VectorXd biases = with_biases_found(replay, library, 1);
  const Innovations nominal = replay.run(library.model(biases));
  expect_same(rms_of(nominal.grid),
              {1.8026848, 0.331517835, 0.16829673, 0.00200244073, 0.00383151463, 0.0031855717, 0.00426570227,
               0.00430641622, 0.0739424149, 0.0169296939, 0.0143805125, 0.01557518, 0.0133236344, 0.00312063021},
              "nominal");
  expect_same(rms_of(nominal.fixes), {1.24540391, 0.787572747, 0.0873279279, 0.0849865936}, "fixes");
  const Innovations coarse = replay.run_coarsely(library.model(biases));
  const auto expect_change = [&](std::string_view effect, const std::vector<double>& wanted) {
    for (std::size_t e = 0; e < library.size(); ++e) {
      if (library[e].name != effect) continue;
      Eigen::VectorXd values = biases;
      const Eigen::Index j = library.first(e);
      values[j] = library.unknowns()[static_cast<std::size_t>(j)].typical;
      const Eigen::MatrixXd change = replay.run_coarsely(library.model(values)).grid - coarse.grid;
      const std::vector<double> all = rms_of(change);
      expect_same({all[gyro_yaw_a], all[force_x], all[force_z], all[depth]}, wanted, std::string(effect));
    }
  };
  expect_change("buoyancy", {0.000138520904, 0.00160266783, 0.00574381022, 0.0206120527});
  expect_change("elevator_offset", {0.000312379127, 0.000546953787, 0.0292194131, 0.0125319482});
  expect_change("fin_backlash", {0.0102019248, 0.00120412804, 0.0196622091, 0.00748539275});
  expect_change("fin_gain", {0.00475722456, 0.000715089713, 0.00227473278, 0.000437664078});
  expect_change("fin_lag", {0.0229582004, 0.00172238428, 0.0113592292, 0.0011816716});
  expect_change("fin_offset", {0.0292149041, 0.00106017488, 0.000335626607, 0.000119027162});
  expect_change("thrust_scale", {0.00126504891, 0.00116962936, 0.00117948385, 0.00112255998});
  expect_change("yaw_damping", {0.00439371803, 0.000300027322, 0.000135547448, 2.96189758e-05});
}

}  // namespace
}  // namespace navcal::gap
