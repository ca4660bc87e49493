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
  amount,    ///< in proportion, or nearly
  lag,       ///< it delays or smooths, the longer the more
  backlash,  ///< something stands anywhere within a width
};

/// What to do with the vehicle so that an effect shows as no other effect does. There is no default: an effect
/// without one does not compile.
class TellingManoeuvre {
 public:
  // Not explicit: a description names the text alone.
  constexpr TellingManoeuvre(const char* text) : text_(text) {  // NOLINT(google-explicit-constructor)
    if (text_.empty()) throw "a manoeuvre without a text";      // at compile time, of a constexpr description
  }
  /// For EffectPlace::lines only: no diagnosis asks for such an effect.
  [[nodiscard]] static constexpr TellingManoeuvre none() { return TellingManoeuvre(); }
  /// Empty: none.
  [[nodiscard]] constexpr std::string_view text() const { return text_; }

 private:
  constexpr TellingManoeuvre() = default;
  std::string_view text_;
};

/// What a file says of an effect for people and for those who search among all of them.
struct EffectDescription {
  std::string_view name;
  std::string_view equation;
  std::span<const EffectParameter> parameters;
  TellingManoeuvre manoeuvre;
  /// Names of effects that leave nearly the same traces, by their equations. They are not what a diagnosis said.
  std::span<const std::string_view> confounders = {};
  EffectPlace place = EffectPlace::instruments;
  /// So many parameters in a row are the components of one vector (1: each stands alone): of strength 1 when its
  /// components, each divided by its typical value, have the norm 1.
  std::size_t vector = 1;
  /// Where several act on the same quantity, the lower goes first: soft iron (0), turned triad (1), what remembers
  /// the field (2), what is added (3), lag (4); servo, then gain (0), lag (1), backlash (2), offset (3), fin.
  int order = 3;
  EffectKind kind = EffectKind::amount;
};

}  // namespace navcal::sim
