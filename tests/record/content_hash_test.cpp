// SPDX-License-Identifier: Apache-2.0
#include "record/content_hash.h"

#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <system_error>

#include "tests/support/temporary_folder.h"

namespace navcal::record {
namespace {

TEST(ContentHash, KnowsTheExamplesOfTheStandard) {  // FIPS 180-2, appendix B; the empty text of NIST's vectors
  EXPECT_EQ(sha256_of("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256_of("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(sha256_of(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}

TEST(ContentHash, AFileHasTheHashOfItsContent) {
  const navcal::test::TemporaryFolder folder;
  for (const std::size_t size : {0U, 1U, 262'143U, 262'144U, 262'145U, 600'000U}) {
    std::string content(size, 'x');
    if (size > 0) content.back() = '\0';
    std::ofstream(folder / "file", std::ios::binary) << content;
    EXPECT_EQ(sha256_of_file(folder / "file"), sha256_of(content)) << size;
  }
  EXPECT_THROW((void)sha256_of_file(folder / "nothing"), std::system_error);
  EXPECT_THROW((void)sha256_of_file(folder.path()), std::system_error);
}

TEST(ContentHash, BytesAreTwoDigitsEach) {
  EXPECT_EQ(hexadecimal(std::array<unsigned char, 3>{0x00, 0x0a, 0xff}), "000aff");
}

}  // namespace
}  // namespace navcal::record
