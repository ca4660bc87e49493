// SPDX-License-Identifier: Apache-2.0
#include "protocols/described/meaning.h"

#include <algorithm>
#include <charconv>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "protocols/decimal.h"

namespace navcal::protocols::described {

/// Rows of meanings.txt in the order of Meaning: name, unit of samples (`-`: any), least and greatest number.
const char* meaning_rows();
/// Rows of units.txt in the order of Dimension: name, unit of samples, factor, offset. The first row of a
/// dimension is its unit of samples.
const char* unit_rows();

namespace {

constexpr double kPi = std::numbers::pi;
/// The number of base/gravity.h, which this folder may not use; a test compares the two.
constexpr double kStandardGravity_m_s2 = 9.81;
constexpr std::pair<std::string_view, double> kConstants[] = {
    {"pi", kPi}, {"degree", kPi / 180}, {"gravity", kStandardGravity_m_s2}};

/// "-1pi/2": a number, times a constant, over a number.
double take_number(std::string_view& text) {
  const std::string_view word = take_word(text);
  const std::string_view above = word.substr(0, word.find('/'));
  double number = 0, divisor = 1;
  const char* const end = std::from_chars(above.data(), above.data() + above.size(), number).ptr;
  for (const auto& [name, value] : kConstants)
    if (name == std::string_view(end, above.data() + above.size())) number *= value;
  if (above.size() < word.size()) std::from_chars(&word[above.size() + 1], word.data() + word.size(), divisor);
  return number / divisor;
}

const std::vector<Unit>& units() {
  static const std::vector<Unit> kUnits = [] {
    std::vector<Unit> rows;
    auto dimension = Dimension::any;
    for (std::string_view text = unit_rows(), name; !(name = take_word(text)).empty();) {
      if (take_word(text) == name) dimension = static_cast<Dimension>(static_cast<int>(dimension) + 1);
      const double factor = take_number(text);
      rows.push_back({name, dimension, factor, take_number(text)});
    }
    return rows;
  }();
  return kUnits;
}

const std::vector<MeaningInfo>& meanings() {
  static const std::vector<MeaningInfo> kMeanings = [] {
    std::vector<MeaningInfo> rows;
    for (std::string_view text = meaning_rows(), name; !(name = take_word(text)).empty();) {
      const Unit* const unit = unit_named(take_word(text));
      const double low = take_number(text);
      rows.push_back({name, unit == nullptr ? Dimension::any : unit->dimension, low, take_number(text)});
    }
    if (rows.size() != kMeaningCount) throw std::logic_error("meanings.txt is to have a row for each Meaning");
    return rows;
  }();
  return kMeanings;
}

}  // namespace

const MeaningInfo& info_of(Meaning meaning) { return meanings().at(static_cast<std::size_t>(meaning)); }

std::optional<Meaning> meaning_named(std::string_view name) {
  const auto found = std::ranges::find(meanings(), name, &MeaningInfo::name);
  if (found == meanings().end()) return std::nullopt;
  return static_cast<Meaning>(found - meanings().begin());
}

std::span<const Unit> all_units() { return units(); }

const Unit* unit_named(std::string_view name) {
  const auto found = std::ranges::find(units(), name, &Unit::name);
  return found == units().end() ? nullptr : &*found;
}

}  // namespace navcal::protocols::described
