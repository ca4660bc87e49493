// SPDX-License-Identifier: Apache-2.0
#include "runs/effects.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <initializer_list>

#include "base/angles.h"

namespace navcal::runs {
namespace {

constexpr double kNominalPrior = 0.4, kOtherPrior = 0.12;

bool same_letters(std::string_view a, std::string_view b) {
  return std::ranges::equal(a, b, [](char x, char y) {
    return std::tolower(static_cast<unsigned char>(x)) == std::tolower(static_cast<unsigned char>(y));
  });
}

/// Weight makes the vehicle sink deeper at the same thrust: the net force downwards is thrust less buoyancy in
/// excess. It does nothing to moments under thrust, once attitude at rest is taken off.
std::vector<Prediction> weight_added() {
  std::vector<Prediction> sizes;
  for (const double share : {0.1, 0.2, 0.4, 0.8}) {  // of the thrust
    Prediction size;
    const double heave = std::log1p(share);
    size.shift[kHeaveEarly] = size.shift[kHeaveLater] = heave;
    size.spread[kHeaveEarly] = size.spread[kHeaveLater] = 0.25 * heave;
    size.shift[kSinkLate] = size.spread[kSinkLate] = 0.3 * share;
    sizes.push_back(size);
  }
  return sizes;
}

/// A failed depth sensor misreads the surface, where depth is known to be nothing; or its readings are noisier, or
/// stiller, than water and electronics let them be. What is derived from the depth then tells little.
std::vector<Prediction> depth_sensor_failed() {
  std::vector<Prediction> sizes;
  for (const double sign : {-1.0, 1.0}) {
    for (const double zero_m : {0.06, 0.12, 0.25}) {
      Prediction size;
      size.shift[kDepthZero] = sign * zero_m;
      size.spread[kDepthZero] = zero_m / 3;
      sizes.push_back(size);
    }
    for (const double noise : {0.7, 1.5}) {
      Prediction size;
      size.shift[kDepthNoise] = sign * noise;
      size.spread[kDepthNoise] = 0.4 * noise;
      size.spread[kDepthZero] = 0.05;
      size.spread[kHeaveEarly] = size.spread[kHeaveLater] = size.spread[kSinkLate] = noise;
      sizes.push_back(size);
    }
  }
  return sizes;
}

/// A damaged propeller loses a share of its thrust: of four thrusters the vehicle then loses a quarter of that
/// share, and gains moments of unknown sign about all axes (which propeller it is, and which way it turns, is
/// unknown). Its blades no longer pull alike, so its torque, which is about the yaw axis, ripples at the shaft's
/// rate.
std::vector<Prediction> propeller_damaged(std::initializer_list<double> shares,
                                          std::initializer_list<double> lines_dB) {
  constexpr double kThrusters = 4;
  std::vector<Prediction> sizes;
  for (const double share : shares) {
    for (const double line_dB : lines_dB) {
      Prediction size;
      const double heave = std::log1p(-share / kThrusters);
      size.shift[kHeaveEarly] = size.shift[kHeaveLater] = heave;
      size.spread[kHeaveEarly] = size.spread[kHeaveLater] = 0.7 * std::abs(heave);
      size.shift[kSinkLate] = -0.25 * share;
      size.spread[kSinkLate] = 0.25 * share;
      size.spread[kRollTrim] = size.spread[kPitchTrim] = 8 * base::kRadiansPerDegree * share;
      size.spread[kYawRateLate] = size.spread[kYawRateEarly] = 40 * base::kRadiansPerDegree * share;
      size.line_dB = line_dB;
      size.line_shows = 0.8;
      sizes.push_back(size);
    }
  }
  return sizes;
}

std::vector<Prediction> predictions_of(const EffectInformation& effect) {
  if (effect.family == "weight") return weight_added();
  if (effect.family == "depth sensor") return depth_sensor_failed();
  // A slight damage costs up to a fifth of a propeller's thrust, and its ripple at most doubles the power of its
  // band.
  const bool slight = effect.name.ends_with("slight");
  return slight ? propeller_damaged({0.05, 0.1, 0.2}, {1.5, 3}) : propeller_damaged({0.3, 0.5, 0.8}, {5, 8});
}

class UnknownCause {
 public:
  explicit UnknownCause(const ParameterVector& scatter) : scatter_(scatter) {}

  /// These parameters are off, both ways.
  void off(std::initializer_list<Parameter> parameters) {
    for (const double far : kFar) {
      Prediction size;
      for (const Parameter i : parameters) size.spread[i] = far * scatter_[i];
      predictions.push_back(size);
    }
  }
  /// These parameters are off in the direction of the sign.
  void off_to(double sign, std::initializer_list<Parameter> parameters) {
    for (const double far : kFar) {
      Prediction size;
      for (const Parameter i : parameters) {
        size.shift[i] = sign * 0.8 * far * scatter_[i];
        size.spread[i] = 0.5 * far * scatter_[i];
      }
      predictions.push_back(size);
    }
  }
  void line() {
    Prediction size;
    size.line_dB = 6;
    predictions.push_back(size);
  }

  std::vector<Prediction> predictions;

 private:
  static constexpr std::array<double, 2> kFar{2.5, 6};  // in standard deviations over nominal runs
  ParameterVector scatter_;
};

std::vector<Prediction> unknown_cause(const ParameterVector& scatter, std::string_view removed_family,
                                      bool propellers_known) {
  UnknownCause unknown(scatter);
  if (removed_family == "depth sensor") {
    unknown.off({kDepthZero});
    unknown.off({kDepthNoise});
  }
  if (removed_family == "weight") unknown.off_to(1, {kHeaveEarly, kHeaveLater});
  unknown.off_to(-1, {kHeaveEarly, kHeaveLater});
  if (!propellers_known) unknown.line();
  unknown.off({kRollTrim, kPitchTrim});
  unknown.off({kYawRateLate, kYawRateEarly});
  return unknown.predictions;
}

}  // namespace

const EffectInformation* effect_named(std::string_view name) {
  for (const auto& effect : kEffects) {
    if (same_letters(name, effect.name) || same_letters(name, effect.words)) return &effect;
  }
  return nullptr;
}

std::vector<Hypothesis> hypotheses(const ParameterVector& scatter, const EffectInformation* removed) {
  std::vector<Hypothesis> all;
  all.push_back({nullptr, false, kNominalPrior, {Prediction{}}});
  bool propellers_known = false;
  for (const auto& effect : kEffects) {
    if (&effect == removed) continue;
    propellers_known = propellers_known || effect.family == "propeller";
    all.push_back({&effect, false, kOtherPrior, predictions_of(effect)});
  }
  all.push_back({nullptr, true, kOtherPrior,
                 unknown_cause(scatter, removed != nullptr ? removed->family : "", propellers_known)});
  return all;
}

}  // namespace navcal::runs
