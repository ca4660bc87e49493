// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace navcal::gap {

/// Share of the difference in depth by which a frame of the card corrects the estimator.
inline constexpr double kDepthGain = 0.03;

}  // namespace navcal::gap
