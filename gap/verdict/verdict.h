// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "gap/inference/library.h"
#include "gap/inference/search.h"
#include "gap/verdict/diagnosis.h"
#include "gap/verdict/holdout.h"

namespace navcal::gap {

/// Grounds of a verdict.
struct Grounds {
  const SearchResult& found;
  const Library& library;
  const std::vector<WhereEntry>& where;     ///< significant cells of the residual map, before
  const std::vector<WhereEntry>& leftover;  ///< significant cells with all that was found in the model
  std::vector<double> held_out_nats;        ///< gains of missions that were held out, or of blocks
  PooledClosure closure;                    ///< by the effects alone
  PooledClosure closure_by_all;             ///< with the tolerances that go with them; of blocks, not clear
  bool blocks = false;                      ///< blocks of the same mission instead of others
};

struct Judgement {
  Verdict verdict = Verdict::unknown;
  std::vector<std::string> reasons;  ///< why the gap is not explained
  /// Kind of the verdict unknown: outside, or cannot_say where every reason is a lack of evidence.
  UnknownKind kind = UnknownKind::cannot_say;
};

/// Judges a diagnosis. A subset of effects explains a gap when it is clearly the most probable and leaves no
/// significant residuals. It must also improve the prediction of held-out data, close the gap there, and have
/// plausible strengths.
[[nodiscard]] Judgement judge(const Grounds& grounds);

}  // namespace navcal::gap
