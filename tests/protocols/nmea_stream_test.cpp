// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "protocols/nmea.h"
#include "protocols/nmea_decimal.h"
#include "tests/protocols/gps_text.h"

namespace navcal::protocols::test {
namespace {

Outcome parsed_nmea(const std::string& text) { return all_at_once<nmea::Scanner>(bytes_of(text)); }

TEST(NmeaStream, TalkerAndTypeAreTheIdentifier) {
  EXPECT_EQ(ids(parsed_nmea(line("GPGGA,,,,,,0,,,,M,,M,,") + line("PTNTHTM,1,N") + line("HCHDM,182.3,M") +
                            line("PUBX,00"))),
            "GPGGA PTNTHTM HCHDM PUBX ");
  EXPECT_EQ(ids(parsed_nmea("!AIVDM,1,1,,A,0*0A\r\n")), "AIVDM ");
  EXPECT_EQ(ids(parsed_nmea(line("PSTMTESTRF"))), "PSTMTESTRF ") << "sixteen characters at most";
}

TEST(NmeaStream, TheChecksumIsRequired) {
  EXPECT_EQ(ids(parsed_nmea("$HCHDM,182.3,M*21\r\n")), "HCHDM ");
  EXPECT_EQ(ids(parsed_nmea("$HCHDM,182.3,M\r\n")), "");
  EXPECT_EQ(parsed_nmea("$HCHDM,182.3,M\r\n").bad_checksum, 1U);
  EXPECT_EQ(parsed_nmea("$HCHDM,182.3,M*22\r\n").bad_checksum, 1U);
  EXPECT_EQ(parsed_nmea("$HCHDM,182.3,M*\r\n").bad_checksum, 1U);
}

TEST(NmeaStream, APortMayTakeSentencesWithoutAChecksum) {
  StreamParser<nmea::PortScanner> strict, parser(nmea::PortScanner{{}, false});
  std::string seen, fields;
  const auto note = [&](const Frame& frame) {
    const nmea::Sentence sentence(frame.bytes);
    seen += std::string(sentence.address()) + ' ';
    fields += std::string(sentence[sentence.size() - 1]) + '|';
  };
  const std::string text =
      "$HCHDM,182.3,M\r\n$HCHDM,182.3,M*21\r\n$HCHDM,182.3,M*22\r\n$SDDBT,1,f,2,M,3,F\r\r\n$IIRSA,1\n";
  parser.feed(bytes_of(text), note);
  EXPECT_EQ(seen, "HCHDM HCHDM SDDBT IIRSA ");
  EXPECT_EQ(fields, "M|M|F|1|");
  EXPECT_EQ(parser.counters().bad_checksum, 1U);
  EXPECT_EQ(parser.held(), 0U);
  strict.feed(bytes_of(text), [](const Frame&) {});
  EXPECT_EQ(strict.counters().frames, 1U);
}

TEST(NmeaStream, LineFeedAloneEndsASentenceToo) {
  EXPECT_EQ(ids(parsed_nmea("$HCHDM,182.3,M*21\n$HCHDM,182.3,M*21\r\n")), "HCHDM HCHDM ");
  EXPECT_EQ(ids(parsed_nmea("$HCHDM,182.3,M*21$HCHDM,182.3,M*21\r\n")), "HCHDM ");
}

TEST(NmeaStream, ACutSentenceCostsOnlyItself) {
  const std::string sentence = line("GPGLL,5209.7838,N,02048.4819,E,171245.00,A");
  for (std::size_t kept = 0; kept < sentence.size(); ++kept) {
    const Outcome seen = parsed_nmea(sentence.substr(0, kept) + sentence);
    EXPECT_EQ(ids(seen), "GPGLL ") << kept;
    EXPECT_EQ(seen.skipped_bytes, kept);
    EXPECT_EQ(seen.held, 0U);
  }
}

TEST(NmeaStream, LongSentencesAreTakenUpToABound) {
  const auto of_length = [](std::size_t n) { return line("IIXDR," + std::string(n - 12, 'x')); };
  EXPECT_EQ(ids(parsed_nmea(of_length(nmea::kMaxLength))), "IIXDR ");
  const Outcome longer = parsed_nmea(of_length(nmea::kMaxLength + 1) + line("HCHDM,1.0,M"));
  EXPECT_EQ(ids(longer), "HCHDM ");
}

TEST(NmeaStream, DollarsInNoiseHoldNothing) {
  EXPECT_EQ(ids(parsed_nmea("$$$!$ $,$*00\r\n$" + line("HCHDM,1.0,M"))), "HCHDM ");
  EXPECT_EQ(parsed_nmea("cost: $ 5").held, 0U);
}

TEST(NmeaStream, EverySingleBitErrorIsSeenOrKeepsTheSentence) {
  const std::string good = line("GPGLL,5209.7838,N,02048.4819,E,171245.00,A");
  for (std::size_t bit = 0; bit < 8 * good.size(); ++bit) {
    std::string damaged = good;
    damaged[bit / 8] = static_cast<char>(damaged[bit / 8] ^ (1 << (bit % 8)));
    const Outcome seen = parsed_nmea(damaged);
    // Only the case of a hexadecimal digit may change without harm.
    if (!seen.frames.empty()) {
      EXPECT_EQ(damaged.substr(0, good.size() - 4), good.substr(0, good.size() - 4)) << bit;
    }
  }
}

TEST(NmeaType, AnyTalkerButNoMakersWord) {
  EXPECT_EQ(nmea::type_of(FrameId("GPGGA")), nmea::Type::gga);
  EXPECT_EQ(nmea::type_of(FrameId("GNRMC")), nmea::Type::rmc);
  EXPECT_EQ(nmea::type_of(FrameId("HCHDM")), nmea::Type::hdm);
  EXPECT_EQ(nmea::type_of(FrameId("SDDBT")), nmea::Type::dbt);
  EXPECT_EQ(nmea::type_of(FrameId("PTNTHTM")), nmea::Type::ptnthtm);
  EXPECT_EQ(nmea::type_of(FrameId("PGGGA")), nmea::Type::other);
  EXPECT_EQ(nmea::type_of(FrameId("GPGGAX")), nmea::Type::other);
  EXPECT_EQ(nmea::type_of(FrameId("GGA")), nmea::Type::other);
  EXPECT_EQ(nmea::type_of(FrameId()), nmea::Type::other);
}

TEST(NmeaSentence, FieldsAreViewsAndEmptyBeyondTheEnd) {
  const std::string text = line("GPXYZ,a,,c");
  const nmea::Sentence sentence(bytes_of(text));
  EXPECT_EQ(sentence.address(), "GPXYZ");
  ASSERT_EQ(sentence.size(), 3U);
  EXPECT_EQ(sentence[0], "a");
  EXPECT_EQ(sentence[1], "");
  EXPECT_EQ(sentence[2], "c");
  EXPECT_EQ(sentence[3], "");
  EXPECT_EQ(sentence[400], "");
  const std::string bare = line("GPXYZ");
  EXPECT_EQ(nmea::Sentence(bytes_of(bare)).size(), 0U);
  const std::string commas = line("GPXYZ" + std::string(nmea::kMaxLength - 11, ','));
  EXPECT_EQ(nmea::Sentence(bytes_of(commas)).size(), nmea::kMaxLength - 11);
}

TEST(NmeaDecimal, IsExactAndStrict) {
  using nmea::parse_decimal;
  EXPECT_EQ(parse_decimal("-12.40"), (nmea::Decimal{-1240, 2}));
  EXPECT_EQ(parse_decimal("+7"), (nmea::Decimal{7, 0}));
  EXPECT_EQ(parse_decimal(".5"), (nmea::Decimal{5, 1}));
  EXPECT_EQ(parse_decimal("5."), (nmea::Decimal{5, 0}));
  EXPECT_EQ(parse_decimal("00012"), (nmea::Decimal{12, 0}));
  for (const char* text :
       {"", "-", "+", ".", "1.2.3", "1e5", "12E002", "nan", "inf", "0x1", " 1", "1 ", "--1", "1234567890123456"}) {
    EXPECT_FALSE(parse_decimal(text)) << text;
  }
  Random random(1);
  for (int i = 0; i < 10000; ++i) {
    const std::string text =
        std::to_string(below(random, 1000000)) + '.' + std::to_string(below(random, 1000000000));
    EXPECT_EQ(parse_decimal(text).value().value(), std::stod(text)) << text;
  }
}

}  // namespace
}  // namespace navcal::protocols::test
