#include "gap/biases.h"

#include <Eigen/Cholesky>
#include <array>
#include <utility>

#include "gap/linearised.h"

namespace navcal::gap {

Eigen::VectorXd with_biases_fitted(const Replay& replay, const Library& library, const Whitening& whitening,
                                   Eigen::VectorXd values, unsigned threads) {
  constexpr std::array<Eigen::Index, Library::kBiases> kColumns{0, 1, 2, 3};
  const Linearised linear =
      relinearise(replay, library, whitening, {values, {}, {}, {}, {}}, values, kColumns, threads);
  Eigen::Matrix4d gram = linear.gram.topLeftCorner<Library::kBiases, Library::kBiases>();
  gram.diagonal().array() += 1e-9 * gram.trace() + 1e-12;
  values.head<Library::kBiases>() += gram.llt().solve(linear.score.head<Library::kBiases>());
  return values;
}

Eigen::VectorXd with_biases_found(const Replay& replay, const Library& library, unsigned threads) {
  constexpr int kIterations = 2;
  Eigen::VectorXd values = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(library.unknowns().size()));
  for (int i = 0; i < kIterations; ++i) {
    values = with_biases_fitted(replay, library, Whitening::nominal(), std::move(values), threads);
  }
  return values;
}

}  // namespace navcal::gap
