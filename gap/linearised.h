#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "gap/library.h"
#include "gap/replay.h"
#include "gap/whitening.h"

namespace navcal::gap {

/// A mission's whitened innovations as a linear function of the library's unknowns about a point:
///   r(values) = residual - design (values - at).
/// The design is made of finite differences of the whole replay, so that what the estimator absorbs is accounted
/// for.
struct Linearised {
  Eigen::VectorXd at;        ///< of all unknowns
  Eigen::VectorXd residual;  ///< whitened, at that point
  Eigen::MatrixXd design;    ///< a column for each unknown
  Eigen::MatrixXd gram;      ///< design^T design
  Eigen::VectorXd score;     ///< design^T residual
};

[[nodiscard]] Layout layout_of(const Replay& replay);

/// All columns anew.
[[nodiscard]] Linearised linearise(const Replay& replay, const Library& library, const Whitening& whitening,
                                   const Eigen::VectorXd& at, unsigned threads);
/// About another point; only `columns` are taken anew, the others from `from`.
[[nodiscard]] Linearised relinearise(const Replay& replay, const Library& library, const Whitening& whitening,
                                     const Linearised& from, const Eigen::VectorXd& at,
                                     std::span<const Eigen::Index> columns, unsigned threads);

}  // namespace navcal::gap
