// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>

namespace navcal::sim {

/// One number of an effect. Zero is neutral.
struct EffectParameter {
  std::string_view name;  ///< with its unit, as files and answers say it: "x_uT_per_A"
  double typical = 1;     ///< what counts as strength 1
  double least = -std::numeric_limits<double>::infinity();
  double greatest = std::numeric_limits<double>::infinity();
};

/// Where an effect acts.
enum class EffectPlace : std::uint8_t {
  instruments,  ///< what they measure
  vehicle,      ///< how the vehicle moves
  lines,        ///< noise, clocks and the way of frames to the host: no cause of a gap, but a trial of the host
};

/// How what it does grows with its parameters: a diagnosis that goes by straight lines must know where there are
/// none.
enum class EffectKind : std::uint8_t {
  amount,  ///< in proportion, or nearly
  lag,     ///< it delays or smooths, the longer the more
  play,    ///< something stands anywhere within a width
};

/// What a file says of an effect for people and for those who search among all of them.
struct EffectDescription {
  std::string_view name;
  std::string_view equation;
  std::span<const EffectParameter> parameters;
  EffectPlace place = EffectPlace::instruments;
  /// So many parameters in a row are the components of one vector (1: each stands alone): of strength 1 when its
  /// components, each divided by its typical value, have the norm 1.
  std::size_t vector = 1;
  /// Where several act on the same quantity, the lower goes first: soft iron (0), turned triad (1), what remembers
  /// the field (2), what is added (3), lag (4); servo, then gain (0), lag (1), play (2), offset (3), fin.
  int order = 3;
  EffectKind kind = EffectKind::amount;
};

}  // namespace navcal::sim
