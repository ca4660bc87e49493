// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "gap/inference/library.h"
#include "gap/inference/search.h"
#include "gap/verdict/diagnosis.h"
#include "gap/verdict/holdout.h"

namespace navcal::gap {

/// What a verdict rests on.
struct Grounds {
  const SearchResult& found;
  const Library& library;
  const std::vector<WhereEntry>& where;     ///< clear of nulls, before
  const std::vector<WhereEntry>& leftover;  ///< clear of nulls, after all that was found is in the model
  std::vector<double> held_out_nats;        ///< gains of missions that were held out, or of blocks
  PooledClosure closure;                    ///< by the effects alone
  PooledClosure closure_by_all;             ///< with the tolerances that go with them; of blocks, not clear
  bool blocks = false;                      ///< blocks of the same mission instead of others
};

struct Judgement {
  Verdict verdict = Verdict::unknown;
  std::vector<std::string> reasons;  ///< why not explained
};

/// A set of effects explains a gap when it is clearly the most probable, leaves nothing that nulls would not show,
/// improves what was held out, closes the gap there, and is of a size that can be.
[[nodiscard]] Judgement judge(const Grounds& grounds);

}  // namespace navcal::gap
