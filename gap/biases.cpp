#include "gap/biases.h"

#include <Eigen/Cholesky>
#include <array>

#include "gap/linearised.h"

namespace navcal::gap {

Eigen::VectorXd with_biases_found(const Replay& replay, const Library& library, unsigned threads) {
  constexpr std::array<Eigen::Index, Library::kBiases> kColumns{0, 1, 2, 3};
  constexpr int kIterations = 2;  // the replay is nearly linear in them
  Eigen::VectorXd values = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(library.unknowns().size()));
  for (int i = 0; i < kIterations; ++i) {
    const Linearised linear =
        relinearise(replay, library, Whitening::nominal(), {values, {}, {}, {}, {}}, values, kColumns, threads);
    Eigen::Matrix4d gram = linear.gram.topLeftCorner<Library::kBiases, Library::kBiases>();
    gram.diagonal().array() += 1e-9 * gram.trace() + 1e-12;
    values.head<Library::kBiases>() += gram.llt().solve(linear.score.head<Library::kBiases>());
  }
  return values;
}

}  // namespace navcal::gap
