// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cctype>
#include <string>

#include "protocols/tcm2.h"
#include "tests/protocols/gps_text.h"
#include "tests/protocols/stream.h"
#include "tests/protocols/text.h"

namespace navcal::protocols::test {
namespace {

Outcome parsed_tcm2(std::string_view text) { return all_at_once<tcm2::Scanner>(bytes_of(text)); }

TEST(Tcm2Stream, RepliesAndWordsInterleave) {
  const Outcome seen = parsed_tcm2(line("C1.0") + ":E010\r\n" + line("C2.0") + ":\r\n" + ":uc=d\r\n" +
                                   line("HCHDM,3.0,M") + "H9V8M7.6\r\n" + "TCM2.50 V1.02\r\n" + line("P-1.0R2.0"));
  EXPECT_EQ(ids(seen), "WORD REPLY WORD REPLY REPLY HCHDM REPLY BANNER WORD ");
  EXPECT_EQ(seen.skipped_bytes + seen.bad_checksum, 0U) << "a refused command is no fault of the data";
}

TEST(Tcm2Stream, ChecksumInEitherCase) {
  EXPECT_EQ(ids(parsed_tcm2("$C328.3T22.3*2E\r\n")), "WORD ");
  EXPECT_EQ(ids(parsed_tcm2("$C328.3T22.3*2e\r\n")), "WORD ");
  EXPECT_EQ(parsed_tcm2("$C328.3T22.3*2F\r\n").bad_checksum, 1U);
  EXPECT_EQ(parsed_tcm2("$C328.3T22.3*EG\r\n").bad_checksum, 1U);
}

TEST(Tcm2Stream, LineFeedAloneEndsALineToo) {
  EXPECT_EQ(ids(parsed_tcm2("$C326.3*69\n:\n$C326.3*69\r\n")), "WORD REPLY WORD ");
  EXPECT_EQ(parsed_tcm2("$C326.3*69\rX").bad_checksum, 1U);
}

TEST(Tcm2Stream, AnyFieldMayBeTheFirst) {
  for (const std::string_view body : {"C1.0", "P-1.0", "R.5", "X1.00", "Y-1.00", "Z1.00", "T1.0", "E001"}) {
    EXPECT_EQ(ids(parsed_tcm2(line(body))), "WORD ") << body;
  }
}

TEST(Tcm2Stream, OtherSentencesAreNotFrames) {
  for (const std::string_view body :
       {"GPGGA,1,2", "PTNTHTM,14223,N", "TIROT,1.0,A", "HCHDT,1.0,T", "HEHDM,1.0,M", "CRMC,1", "", "1.0", "*"}) {
    const Outcome seen = parsed_tcm2(line(body) + line("C1.0"));
    EXPECT_EQ(ids(seen), "WORD ") << body;
  }
}

TEST(Tcm2Stream, ACutWordCostsOnlyItself) {
  const std::string word = line("C328.3P28.4R-12.4X55.11Y12.33Z-18.43T22.3E001");
  for (std::size_t kept = 0; kept < word.size(); ++kept) {
    const Outcome seen = parsed_tcm2(word.substr(0, kept) + word + ":\r\n");
    EXPECT_EQ(ids(seen), "WORD REPLY ") << kept;
    EXPECT_EQ(seen.held, 0U);
    EXPECT_EQ(seen.skipped_bytes, kept);
  }
}

TEST(Tcm2Stream, AReplyBehindACutWordIsFound) {
  EXPECT_EQ(ids(parsed_tcm2("$C328.3P28\r\n:E010\r\n")), "REPLY ");
  EXPECT_EQ(ids(parsed_tcm2("$C328.3P28:\r\n")), "REPLY ") << "without waiting for the next word";
}

TEST(Tcm2Stream, AStrayColonInADamagedWordMakesNoReply) {
  const Outcome seen = parsed_tcm2("$C328.3:E200*00\r\n");
  EXPECT_TRUE(seen.frames.empty());
  EXPECT_EQ(seen.bad_checksum, 1U);
}

TEST(Tcm2Stream, EveryFlippedBitIsNoticed) {
  const std::string word = line("C328.3P28.4R-12.4X55.11Y12.33Z-18.43T22.3E001");
  for (std::size_t bit = 0; bit < 8 * (word.size() - 2); ++bit) {
    std::string flipped = word;
    flipped[bit / 8] = static_cast<char>(flipped[bit / 8] ^ (1 << bit % 8));
    if (std::equal(word.begin(), word.end(), flipped.begin(),
                   [](char a, char b) { return std::toupper(a) == std::toupper(b); }) &&
        bit / 8 > word.find('*')) {
      continue;  // the checksum in the other case is the same checksum
    }
    for (const Seen& frame : parsed_tcm2(flipped + "\r\n").frames) EXPECT_NE(frame.id, tcm2::kWord) << flipped;
  }
}

TEST(Tcm2Stream, ALineWithoutEndIsLeftAtTheMaximum) {
  const std::string endless = "$C" + std::string(tcm2::Scanner::kMaxFrameLength - 3, '1');
  EXPECT_EQ(parsed_tcm2(endless).held, endless.size());
  const Outcome seen = parsed_tcm2(endless + "1" + line("C1.0"));
  EXPECT_EQ(ids(seen), "WORD ");
}

TEST(Tcm2Stream, TheLongestLineFits) {
  const std::string longest = line("C1." + std::string(tcm2::Scanner::kMaxFrameLength - 9, '0'));
  ASSERT_EQ(longest.size(), tcm2::Scanner::kMaxFrameLength);
  EXPECT_EQ(ids(parsed_tcm2(longest)), "WORD ");
  EXPECT_EQ(ids(parsed_tcm2(line("C1." + std::string(tcm2::Scanner::kMaxFrameLength - 8, '0')))), "");
}

TEST(Tcm2Stream, ABannerIsALineOfItsOwnLength) {
  EXPECT_EQ(ids(parsed_tcm2("TCM2, ready\r\n")), "BANNER ");
  EXPECT_EQ(ids(parsed_tcm2("TCM3, ready\r\n")), "");
  EXPECT_EQ(ids(parsed_tcm2("TCM2, \x01\r\n")), "") << "noise is no banner";
  EXPECT_EQ(ids(parsed_tcm2("TCM2 " + line("C1.0"))), "WORD ");
}

}  // namespace
}  // namespace navcal::protocols::test
