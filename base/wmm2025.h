// SPDX-License-Identifier: Apache-2.0
// Coefficients of the World Magnetic Model 2025 (NOAA National Centers for Environmental Information and British
// Geological Survey, 2024; public domain). Epoch 2025.0, valid until 2030.0.
#pragma once

#include <array>
#include <cstddef>

namespace navcal::base {

/// One term of the spherical harmonic expansion of the main field, Schmidt semi-normalised.
struct GaussCoefficient {
  int degree = 0, order = 0;
  double g_nT = 0, h_nT = 0;                    ///< at the epoch
  double g_nT_per_year = 0, h_nT_per_year = 0;  ///< secular variation
};

inline constexpr int kWmm2025Degree = 12;
inline constexpr std::size_t kWmm2025Terms = 90;
inline constexpr double kWmm2025Epoch = 2025.0;  ///< decimal year
inline constexpr double kWmm2025End = 2030.0;    ///< the model's validity ends
/// In the order of degree, then order; from wmm2025.csv.
extern const std::array<GaussCoefficient, kWmm2025Terms> kWmm2025;

}  // namespace navcal::base
