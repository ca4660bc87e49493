// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gap/verdict/diagnosis.h"
#include "record/json/put_members.h"

namespace navcal::gap {

/// A cell of the residual map, with the keys of `where` (docs/gap.md).
NAVCAL_JSON_MEMBERS(WhereEntry, channel, regime, gap, unit, floor, p_value)

}  // namespace navcal::gap
