// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "config/mission.h"
#include "validation/reference/mission.h"
#include "validation/reference/rng.h"

namespace navcal::validation {

/// A mission file as orders to the reference vehicle's own helmsman. Steps that end by what the vehicle does (a
/// dive, a circle) get the time that they take a vehicle of this size at a metre a second. The mission begins at
/// the surface.
[[nodiscard]] reference::Mission sailed_plan(const config::Mission& steps, double most_s);

/// Manoeuvres by chance: rudder, depth, speed and heading change every four to ten seconds.
[[nodiscard]] reference::Mission random_manoeuvres(double seconds, reference::Rng& dice);

}  // namespace navcal::validation
