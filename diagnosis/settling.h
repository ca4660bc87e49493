// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>

#include "diagnosis/recording_fit.h"
#include "diagnosis/set_evidence.h"

namespace navcal::diagnosis {

/// Change of the nominal vehicle by the likelihood of changes.
using ChangeOf = std::function<Eigen::VectorXd(const Likelihood&, const Anchor&)>;
/// Log probability of a change before the recording, but for a constant.
using LogPriorOf = std::function<double(const Eigen::VectorXd&)>;
/// Departures of each recording, and the part of them that is the change of the nominal vehicle.
struct Departures {
  Eigen::VectorXd at, change;
};
/// A recording linearised again and again where it says that its vehicle is, until its evidence settles. nullopt:
/// a vehicle could not have moved so. Only recordings that have settled alike compare.
[[nodiscard]] std::optional<RecordingFit> settled(
    const RecordingModel& recording, const JointPrior& prior, Departures from, const ChangeOf& change_of,
    const LogPriorOf& log_prior_of = [](const auto&) { return 0.0; });

}  // namespace navcal::diagnosis
