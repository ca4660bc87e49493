// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

#include "gap/verdict/diagnosis.h"

namespace navcal::report {

/// A cell of the residual map, with the keys of `where` (docs/gap.md).
[[nodiscard]] inline nlohmann::ordered_json where_json(const gap::WhereEntry& where) {
  return {{"channel", where.channel}, {"regime", where.regime}, {"gap", where.gap},
          {"unit", where.unit},       {"floor", where.floor},   {"p_value", where.p_value}};
}

}  // namespace navcal::report
