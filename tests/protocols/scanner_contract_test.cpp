// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "protocols/parsers.h"
#include "tests/protocols/described_samples.h"
#include "tests/protocols/doppler_text_samples.h"
#include "tests/protocols/gps_samples.h"
#include "tests/protocols/mip_samples.h"
#include "tests/protocols/pd0_samples.h"
#include "tests/protocols/pressure_samples.h"
#include "tests/protocols/samples.h"
#include "tests/protocols/stream.h"
#include "tests/protocols/trax_samples.h"
#include "tests/protocols/ubx_samples.h"
#include "tests/protocols/vectornav_samples.h"

// Requirements of StreamParser on every scanner (protocols/stream_parser.h).
namespace navcal::protocols::test {
namespace {

bool operator==(const Scan& a, const Scan& b) { return a.kind == b.kind && a.length == b.length && a.id == b.id; }

template <class S>
class ScannerContract : public testing::Test {};

/// A described device has no frames without a description.
template <class S>
struct WithDescription {
  using Type = S;
};
template <>
struct WithDescription<described::Scanner> {
  using Type = described::test::CardScanner;
};

/// The scanner of each device, those of what is sent to devices, and that of a port where two protocols can come.
template <class Rows>
struct AllScanners;
template <std::size_t... Row>
struct AllScanners<std::index_sequence<Row...>> {
  using Types =
      testing::Types<typename WithDescription<typename ScannersOf<kDeviceTypes[Row].protocol>::Own>::Type...,
                     tcm2::CommandScanner, oncore::CommandScanner, GpsStreamScanner, ubx::PortScanner>;
};
TYPED_TEST_SUITE(ScannerContract, AllScanners<std::make_index_sequence<kDeviceCount>>::Types);

TYPED_TEST(ScannerContract, DecidesOnThePrefixAndStaysWithIt) {
  const TypeParam scanner;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    Random random(seed);
    const Buffer stream = mixture(random, random_frame<TypeParam>, 20);
    const std::uint8_t* const last = stream.data() + stream.size();
    for (const std::uint8_t* start = scanner.find_start(stream.data(), last); start != last;
         start = scanner.find_start(start + 1, last)) {
      bool decided = false;
      Scan decision;
      for (const std::uint8_t* end = start + 1; end <= last; ++end) {
        const auto available = static_cast<std::size_t>(end - start);
        const Scan scan = scanner.scan(start, end);
        if (decided) {
          ASSERT_TRUE(scan == decision) << "changed its mind after " << available << " bytes";
          if (available > 2 * TypeParam::kMaxFrameLength) break;
        } else if (scan.kind == Scan::Kind::incomplete) {
          ASSERT_GE(scan.length, 1U);
          ASSERT_LE(available + scan.length, TypeParam::kMaxFrameLength);
        } else {
          decided = true;
          decision = scan;
          if (scan.kind == Scan::Kind::frame) {
            ASSERT_GE(scan.length, 1U);
            ASSERT_LE(scan.length, available);
          }
        }
      }
    }
  }
}

TYPED_TEST(ScannerContract, FindStartSkipsOnlyWhatIsNoFrame) {
  const TypeParam scanner;
  Random random(3);
  for (int i = 0; i < 200; ++i) {
    const Buffer frame = random_frame<TypeParam>(random);
    const std::uint8_t* const last = frame.data() + frame.size();
    EXPECT_EQ(scanner.find_start(frame.data(), last), frame.data());
    EXPECT_EQ(scanner.find_start(last, last), last);
    EXPECT_EQ(scanner.scan(frame.data(), last).length, frame.size());
  }
}

}  // namespace
}  // namespace navcal::protocols::test
