#include "gap/linearised.h"

#include "gap/parallel.h"

namespace navcal::gap {
namespace {

/// -d residual / d unknown, by a difference towards the side that its bounds allow.
Eigen::VectorXd column(const Replay& replay, const Library& library, const Whitening& whitening,
                       const Layout& layout, const Eigen::VectorXd& at, const Eigen::VectorXd& residual,
                       Eigen::Index j) {
  const Unknown& unknown = library.unknowns()[static_cast<std::size_t>(j)];
  double step = unknown.step * unknown.typical;
  if (at[j] + step > unknown.greatest) step = -step;
  Eigen::VectorXd values = at;
  values[j] += step;
  return (residual - whitening(replay.run(library.model(values)), layout)) / step;
}

}  // namespace

Layout layout_of(const Replay& replay) {
  Layout layout{replay.intervals(), {}};
  for (const FixReading& fix : replay.mission().fixes) layout.fix_numbers.push_back(fix.number);
  return layout;
}

Linearised linearise(const Replay& replay, const Library& library, const Whitening& whitening,
                     const Eigen::VectorXd& at, unsigned threads) {
  return relinearise(replay, library, whitening, {at, {}, {}, {}, {}}, at, library.moving(), threads);
}

Linearised relinearise(const Replay& replay, const Library& library, const Whitening& whitening,
                       const Linearised& from, const Eigen::VectorXd& at, std::span<const Eigen::Index> columns,
                       unsigned threads) {
  const Layout layout = layout_of(replay);
  Linearised result;
  result.at = at;
  result.residual = whitening(replay.run(library.model(at)), layout);
  result.design = from.design;
  if (result.design.size() == 0) result.design.setZero(result.residual.size(), at.size());
  in_parallel(threads, columns.size(), [&](std::size_t i) {
    result.design.col(columns[i]) = column(replay, library, whitening, layout, at, result.residual, columns[i]);
  });
  if (from.gram.size() == 0) {
    result.gram = result.design.transpose() * result.design;
  } else {
    result.gram = from.gram;
    for (const Eigen::Index j : columns) {
      const Eigen::VectorXd products = result.design.transpose() * result.design.col(j);
      result.gram.col(j) = products;
      result.gram.row(j) = products.transpose();
    }
  }
  result.score = result.design.transpose() * result.residual;
  return result;
}

}  // namespace navcal::gap
