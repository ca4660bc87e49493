// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gap/data/mission.h"

namespace navcal::gap {

/// Readings and commands of a mission from `from_s` until before `until_s`, as a mission of their own whose times
/// begin at zero. Numbers of fixes, instruments and field are those of the whole mission; silences are found anew.
[[nodiscard]] Mission piece_of(const Mission& mission, double from_s, double until_s);

}  // namespace navcal::gap
