#pragma once

#include "gap/library.h"
#include "gap/replay.h"

namespace navcal::gap {

/// The values of all unknowns at which a diagnosis begins: the gyros' biases by least squares, no effects.
[[nodiscard]] Eigen::VectorXd with_biases_found(const Replay& replay, const Library& library, unsigned threads);

}  // namespace navcal::gap
