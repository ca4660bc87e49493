// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "record/content_hash.h"
#include "validation/cases.h"

namespace navcal::cli {
namespace {

TEST(GapTrialSeal, TheDigestIsOfTruthAndSaltAndTwoSealsOfOneTruthDiffer) {
  const validation::Commitment first = validation::commitment_to("truth"),
                               second = validation::commitment_to("truth");
  EXPECT_EQ(first.digest, record::sha256_of("truth" + first.salt));
  EXPECT_EQ(first.truth, "truth");
  EXPECT_EQ(first.salt.size(), 64U);
  EXPECT_NE(first.salt, second.salt);
  EXPECT_NE(first.digest, second.digest);
}

}  // namespace
}  // namespace navcal::cli
