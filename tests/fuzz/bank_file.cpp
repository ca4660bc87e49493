// SPDX-License-Identifier: Apache-2.0
// Any bytes as a null bank's file, or a good one in which some are changed: nothing, or a bank that can be used.
#include <cstdlib>
#include <cstring>
#include <string>

#include "gap/nulls/bank_cache.h"
#include "gap/replay/regimes.h"
#include "tests/fuzz/source.h"
#include "tests/fuzz/target.h"
#include "tests/gap/nulls/made_up_bank.h"

namespace navcal::fuzz::bank_file_target {

using namespace navcal::gap;

constexpr Eigen::Index kUnknowns = 5;

std::string good_text() {
  NullBank bank = test::made_up_bank(kUnknowns);
  bank.whitening.grid_filter = PredictionErrorFilter(
      Eigen::MatrixXd::Constant(PredictionErrorFilter::kWindows * kEvidenceChannels, kEvidenceChannels, 0.01));
  return bank_text({{1, 2, 3}, bank}, "model");
}

void use(const NullBank& bank) {
  Innovations innovations;
  innovations.grid = Eigen::MatrixXd::Ones(300, kChannels);
  innovations.fixes = Eigen::MatrixXd::Ones(2, kFixChannels);
  const Eigen::VectorXd white = bank.whitening(innovations, {300, {0, 1}});
  if (white.size() != 300 * kEvidenceChannels + 2 * kFixChannels) std::abort();
  if ((bank.gram * bank.scores).cols() != static_cast<Eigen::Index>(bank.powers.size())) std::abort();
  for (Eigen::Index c = 0; c < bank.explained_rms.mean_square.rows(); ++c) {
    for (Eigen::Index k = 0; k < bank.explained_rms.mean_square.cols(); ++k) {
      const double p = bank.explained_rms.p_value(c, k, 1);
      if (!(p >= 0 && p <= 1)) std::abort();
    }
  }
}

NAVCAL_FUZZ(bank_file) {
  static const std::string kGood = good_text();
  if (const auto kept = read_bank({reinterpret_cast<const char*>(data), size}, "model", kUnknowns))
    use(kept->bank);

  navcal::fuzz::Source source({data, size});
  std::string text = kGood;
  for (int changes = source.take<std::uint8_t>() % 8; changes > 0; --changes) {
    text[source.take<std::uint32_t>() % text.size()] = static_cast<char>(source.take<std::uint8_t>());
  }
  if (const auto kept = read_bank(text, "model", kUnknowns)) use(kept->bank);
  return 0;
}

}  // namespace navcal::fuzz::bank_file_target
