// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "validation/arms.h"
#include "validation/missions.h"
#include "validation/reference/effects.h"
#include "validation/reference/run.h"

namespace navcal::validation {

/// A truth that is fixed before anybody answers: the digest (SHA-256, record/content_hash.h) is published first,
/// truth and salt after the last answer, and then everybody can reckon that digest = SHA-256(truth salt), the two
/// texts one after the other. Without the salt the few possible truths could be tried one by one.
struct Commitment {
  std::string truth;
  std::string salt;  ///< 32 random bytes of the kernel, in hexadecimal
  std::string digest;
};

[[nodiscard]] Commitment commitment_to(std::string truth);

/// Keys with their units.
using TrialParameters = std::map<std::string, double, std::less<>>;

/// An effect of a case, as an answer has to name it.
struct TrialEffect {
  std::string name;
  TrialParameters drawn{};      ///< before the tolerance
  TrialParameters real{};       ///< that the vehicle has, tolerance and all
  std::string of{}, of_name{};  ///< what it belongs to: "thruster.2", by the layout "front_port"; may be empty

  /// "thrust_scale of thruster.2".
  [[nodiscard]] std::string full_name() const { return of.empty() ? name : name + " of " + of; }
};

struct LayoutCase;

/// Truth of one case, which a diagnosis must not know before it has answered.
struct TrialCase {
  int number = 1;  ///< from 1
  TrialArm arm = TrialArm::nulls;
  double minutes = 10;  ///< of each mission
  std::vector<TrialEffect> effects;
  std::string excluded;                          ///< effect that the library is to be without
  reference::VehicleUnderTest vehicle;           ///< the effects and the tolerance
  int place_number = 0;                          ///< of a layout: the vehicle's number, from 1
  TrialPlace place;                              ///< of all missions
  std::array<std::uint64_t, 3> mission_seeds{};  ///< of noise and turn-on biases, each mission its own
  std::shared_ptr<const LayoutCase> on_layout;   ///< nullptr: the reference vehicle

  /// Whether the library that the diagnosis has can name what is there (nothing, or effects).
  [[nodiscard]] bool in_library() const;
};

/// The same seed, number, minutes and places give the same case on every machine. `minutes` is that of the
/// missions in arms that have no length of their own; each case takes one of so many places.
[[nodiscard]] TrialCase drawn_case(std::uint64_t seed, int number, double minutes, int places = kTrialPlaces);

/// Which of `count` comes at a place of an endless series, in which each comes once before any comes again. The
/// order of each cycle is drawn from a stream of its own, `stride` after the one before.
[[nodiscard]] std::size_t in_turn(std::uint64_t seed, std::uint64_t stream, std::uint64_t stride, int place,
                                  std::size_t count);

/// The case as a line of JSON: what is sealed.
[[nodiscard]] std::string truth_text(const TrialCase& drawn, std::uint64_t seed);

}  // namespace navcal::validation
