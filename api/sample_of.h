// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <navcal/samples.h>

#include <optional>
#include <vector>

#include "config/settings.h"
#include "instruments/samples.h"
#include "pipeline/battery.h"
#include "pipeline/navigation.h"

namespace navcal::api {

/// The pipeline's sample as the library gives it; nullopt for satellites in view.
[[nodiscard]] std::optional<Sample> sample_of(const instruments::Sample& sample);
[[nodiscard]] Sample sample_of(const pipeline::NavigationSample& sample);
[[nodiscard]] Sample sample_of(const pipeline::BatterySample& sample);

[[nodiscard]] std::vector<Port> ports_of(const config::Settings& settings);

}  // namespace navcal::api
