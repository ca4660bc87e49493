// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>

#include "identify/answer/identification.h"
#include "tests/identify/identification_case.h"

namespace navcal::identify {
namespace {

const FitProgress kSilent = [](auto, auto) {};

/// Keeps one reading of ten and fills in the rest by lines, as some recorders do.
void interpolate(RecordedMotion& motion) {
  constexpr std::size_t kOf = 10;
  for (auto& channel : motion.channels) {
    for (std::size_t a = 0; a + kOf < channel.size(); a += kOf) {
      const double change = channel[a + kOf].value - channel[a].value;
      for (std::size_t k = 1; k < kOf; ++k)
        channel[a + k].value = channel[a].value + static_cast<double>(k) / kOf * change;
    }
  }
}

TEST(Identify, OnlyInterpolatedReadingsAreThinned) {
  const VehicleCase of = vehicle_case("ferry");
  config::Layout truth = of.prior;
  for (auto& thruster : truth.thrusters) thruster.force_scale = 1;
  for (const bool are_interpolated : {false, true}) {
    IdentifyRequest request;
    request.prior = of.prior;
    request.advise = false;
    request.recordings = {draw_steered(truth, are_interpolated ? 120 : 60, 4)};
    if (are_interpolated) interpolate(request.recordings[0]);
    const Identification found = identify(request, kSilent);
    EXPECT_EQ(found.interval_s > 0, are_interpolated) << found.interval_s;
    const bool says_so = std::any_of(found.warnings.begin(), found.warnings.end(), [](const std::string& words) {
      return words.find("neighbouring readings are not independent") != std::string::npos;
    });
    EXPECT_EQ(says_so, are_interpolated);
  }
}

}  // namespace
}  // namespace navcal::identify
