// SPDX-License-Identifier: Apache-2.0
#include <stdexcept>

#include "base/parallel.h"
#include "gap/verdict/prepare.h"
#include "gap/verdict/request.h"

namespace navcal::gap {

MadeBank make_bank(const Request& request, const Progress& progress) {
  const Library library(request.excluded);
  const unsigned threads = base::threads_or_cores(request.threads);
  Preparation preparation(request, library, progress, threads);
  Diagnosis answer;
  const auto prepared = preparation.prepare(request.missions.at(0), answer);
  if (!prepared) return {0, answer.remarks.empty() ? "the recording is empty" : answer.remarks.back()};
  if (!prepared->refusal.empty()) throw std::runtime_error("the null bank cannot be kept: " + prepared->refusal);
  return {prepared->bank.missions, {}};
}

}  // namespace navcal::gap
