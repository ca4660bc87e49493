// SPDX-License-Identifier: Apache-2.0
#include "protocols/gps_stream.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iostream>
#include <iterator>
#include <map>

#include "tests/protocols/gps_samples.h"
#include "tests/protocols/gps_text.h"

namespace navcal::protocols::test {
namespace {

Outcome parsed_gps(const Buffer& stream) { return all_at_once<GpsStreamScanner>(stream); }

TEST(GpsStream, BothLanguagesInOneStream) {
  const Buffer stream =
      joined({oncore::encode_bo({std::int8_t{18}}), buffer_of(line("GPZDA,,,,,,")), oncore::encode_ea({}),
              buffer_of("!AIVDM,1,1,,A,0*0A\r\n"), oncore::encode_bo({})});
  const Outcome seen = parsed_gps(stream);
  EXPECT_EQ(ids(seen), "Bo GPZDA Ea AIVDM Bo ");
  EXPECT_EQ(seen.skipped_bytes, 0U);
}

TEST(GpsStream, ASentenceInsideAFrameBelongsToTheFrame) {
  const std::string sentence = line("GPZDA,,,,,,");
  EXPECT_EQ(ids(parsed_gps(oncore::encode_cj(sentence + "@@Bo"))), "Cj ");
  Buffer cut = oncore::encode_cj(sentence);
  cut.resize(100);
  append(cut, oncore::encode_ea({}));
  append(cut, Buffer(300, 0));
  EXPECT_EQ(ids(parsed_gps(cut)), "GPZDA Ea ") << "the cut frame gives back what was inside";
}

// Exact counts of ORIGIN.md beside the recordings, which are not part of this repository.
TEST(Captures, EveryFrameOfTheRecordedStreamsIsFound) {
  const std::map<std::string, std::pair<std::string, std::map<std::string, int>>> expected = {
      {"oncore-m12.log",
       {"oncore", {{"Ha", 10}, {"Bb", 9}, {"As", 10}, {"Gd", 10}, {"Aw", 10}, {"Ay", 10}, {"Bo", 9}}}},
      {"oncore-binary.log",
       {"oncore",
        {{"Ea", 12}, {"En", 12}, {"Bo", 12}, {"As", 11}, {"At", 11}, {"Aw", 11}, {"Ay", 11}, {"Bb", 2}}}},
      {"oncore.log", {"nmea", {{"GPGGA", 6}, {"GPRMC", 7}, {"GPGLL", 6}, {"GPGSA", 6}, {"GPGSV", 21}}}},
      {"tnt-revolution.log", {"nmea", {{"PTNTHTM", 50}, {"HCXDR", 10}}}},
      {"pypilot.log", {"nmea", {{"APHDM", 7}, {"APROT", 7}, {"APXDR", 15}}}},
  };
  for (const auto& [file, contents] : expected) {
    std::ifstream in(std::string(NAVCAL_SHARED_DIR "/captures/") + file, std::ios::binary);
    if (!in) {
      std::cout << "absent: " << NAVCAL_SHARED_DIR << "/captures/" << file << '\n';
      GTEST_SKIP();
    }
    const Buffer stream{std::istreambuf_iterator<char>(in), {}};
    const Outcome own =
        contents.first == "oncore" ? all_at_once<oncore::Scanner>(stream) : all_at_once<nmea::Scanner>(stream);
    std::map<std::string, int> counts;
    for (const Seen& frame : own.frames) ++counts[std::string(frame.id.view())];
    EXPECT_EQ(counts, contents.second) << file;
    EXPECT_EQ(own.bad_checksum, 0U) << file;
    EXPECT_EQ(parsed_gps(stream).frames, own.frames) << file << " through the scanner of both";
    if (file == "oncore-binary.log") {
      EXPECT_EQ(own.frames.at(0).offset, 789U);
    }
  }
}

}  // namespace
}  // namespace navcal::protocols::test
