// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "gap/verdict/find_effects.h"
#include "gap/verdict/prepare.h"
#include "gap/verdict/request.h"

namespace navcal::gap {

/// A diagnosis together with what it rests on, for steps that go on from it (gap/design).
struct Study {
  explicit Study(Request asked) : request(std::move(asked)), library(request.excluded) {}
  Study(const Study&) = delete;
  Study& operator=(const Study&) = delete;

  Request request;
  Library library;
  std::unique_ptr<Prepared> prepared;  ///< nullptr: the recording cannot be diagnosed, and the remarks say why
  std::vector<std::unique_ptr<Prepared>> together;  ///< diagnosed together with the first one
  std::vector<std::unique_ptr<Prepared>> holdouts;
  std::optional<FoundEffects> found;  ///< there if `prepared` is
  Diagnosis diagnosis;
};

/// diagnose() that keeps what it found. Throws as diagnose() does.
[[nodiscard]] std::unique_ptr<Study> study(const Request& request, const Progress& progress);

}  // namespace navcal::gap
