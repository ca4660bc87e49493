// SPDX-License-Identifier: Apache-2.0
#include "validation/commitment.h"

#include <gtest/gtest.h>

#include "record/content_hash.h"

namespace navcal::cli {
namespace {

TEST(GapTrialSeal, KnowsTheExamplesOfTheStandard) {  // FIPS 180-2, appendix B; the empty text of NIST's vectors
  EXPECT_EQ(record::sha256_of("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(record::sha256_of("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(record::sha256_of(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}

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
