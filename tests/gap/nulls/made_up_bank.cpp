// SPDX-License-Identifier: Apache-2.0
#include "tests/gap/nulls/made_up_bank.h"

#include "gap/replay/regimes.h"

namespace navcal::gap::test {

NullBank made_up_bank(Eigen::Index unknowns) {
  NullBank bank;
  bank.missions = 20;
  bank.seed = 1;
  bank.seconds = 3;
  bank.whitening = Whitening::nominal({});
  bank.gram = Eigen::MatrixXd::Identity(unknowns, unknowns);
  bank.scores = Eigen::MatrixXd::Random(unknowns, 20);
  bank.powers.assign(20, 1.0625);
  bank.explained_rms.mean_square = bank.explained_rms.variance = Eigen::MatrixXd::Ones(
      static_cast<Eigen::Index>(reported_channels().size()), static_cast<Eigen::Index>(regimes().size()));
  bank.left = bank.explained_rms;
  return bank;
}

}  // namespace navcal::gap::test
