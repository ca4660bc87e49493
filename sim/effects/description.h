// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <span>
#include <string_view>

namespace navcal::sim {

/// One number of an effect. Zero is neutral.
struct EffectParameter {
  std::string_view name;  ///< with its unit, as files and answers say it: "x_uT_per_A"
  double typical = 1;     ///< value of strength 1
  double least = -std::numeric_limits<double>::infinity();
  double greatest = std::numeric_limits<double>::infinity();
};

/// Place where an effect acts.
enum class EffectPlace : std::uint8_t {
  instruments,  ///< their measurements
  vehicle,      ///< how the vehicle moves
  lines,        ///< noise, clocks and the way of frames to the host: no cause of a gap, but a trial of the host
};

/// How the result of an effect depends on its parameters. A diagnosis that linearises must know which effects
/// are not linear.
enum class EffectKind : std::uint8_t {
  amount,    ///< in proportion, or nearly
  lag,       ///< it delays or smooths, the longer the more
  backlash,  ///< something stands anywhere within a width
};

/// Manoeuvre during which an effect shows as no other effect does. It has no default, so an effect without one
/// does not compile.
class TellingManoeuvre {
 public:
  // Not explicit: a description names the text alone.
  constexpr TellingManoeuvre(const char* text) : text_(text) {  // NOLINT(google-explicit-constructor)
    if (text_.empty()) throw "a manoeuvre without a text";      // at compile time, of a constexpr description
  }
  /// No manoeuvre: only for EffectPlace::lines, because no diagnosis looks for such an effect.
  [[nodiscard]] static constexpr TellingManoeuvre none() { return TellingManoeuvre(); }
  /// Empty when there is no manoeuvre.
  [[nodiscard]] constexpr std::string_view text() const { return text_; }

 private:
  constexpr TellingManoeuvre() = default;
  std::string_view text_;
};

/// Up to N elements, kept in the list itself; a constexpr description with more does not compile.
template <class T, std::size_t N>
class ShortList {
 public:
  // Not explicit: a description names the elements alone.
  constexpr ShortList(std::span<const T> elements) {  // NOLINT(google-explicit-constructor)
    for (const T& element : elements) elements_.at(size_++) = element;
  }
  constexpr ShortList(std::initializer_list<T> elements)
      : ShortList(std::span(elements.begin(), elements.size())) {}
  [[nodiscard]] constexpr std::size_t size() const { return size_; }
  [[nodiscard]] constexpr bool empty() const { return size_ == 0; }
  [[nodiscard]] constexpr const T* begin() const { return elements_.data(); }
  [[nodiscard]] constexpr const T* end() const { return begin() + size_; }
  [[nodiscard]] constexpr const T& front() const { return elements_.front(); }
  [[nodiscard]] constexpr const T& operator[](std::size_t i) const { return elements_[i]; }

 private:
  std::array<T, N> elements_{};
  std::size_t size_ = 0;
};

/// Members of EffectDescription that most effects leave as they are.
struct EffectTraits {
  /// Names of effects whose traces are nearly the same by their equations. They are not results of a diagnosis.
  ShortList<std::string_view, 4> confounders = {};
  EffectPlace place = EffectPlace::instruments;
  /// Number of consecutive parameters that are the components of one vector (1: each is a scalar). The vector
  /// has strength 1 when its components, each divided by its typical value, have norm 1.
  std::size_t vector = 1;
  /// Order of effects on the same quantity, lowest first: soft iron (0), turned triad (1), effects with a
  /// memory of the field (2), additive effects (3), lag (4); from servo to fin: gain (0), lag (1), backlash
  /// (2), offset (3).
  int order = 3;
  EffectKind kind = EffectKind::amount;
};

/// Static description of an effect, for people and for the search over all effects.
struct EffectDescription : EffectTraits {
  std::string_view name;
  std::string_view equation;
  ShortList<EffectParameter, 12> parameters;
  TellingManoeuvre manoeuvre;
};

[[nodiscard]] constexpr EffectDescription described(std::string_view name, std::string_view equation,
                                                    const ShortList<EffectParameter, 12>& parameters,
                                                    TellingManoeuvre manoeuvre, const EffectTraits& traits = {}) {
  return {traits, name, equation, parameters, manoeuvre};
}

}  // namespace navcal::sim
