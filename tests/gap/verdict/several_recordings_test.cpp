// SPDX-License-Identifier: Apache-2.0
// Several recordings of one vehicle, diagnosed together: short missions against small banks.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "gap/verdict/request.h"
#include "tests/gap/simulated_mission.h"
#include "tests/support/temporary_folder.h"

namespace navcal::gap {
namespace {

constexpr std::string_view kIron = "[hard_iron]\nx_uT = 1.2\ny_uT = 0.8\n";

class SeveralRecordings : public testing::Test {
 protected:
  Diagnosis diagnosis(std::vector<std::filesystem::path> missions,
                      std::vector<std::filesystem::path> holdouts = {}) {
    Request request;
    request.missions = std::move(missions);
    request.holdouts = std::move(holdouts);
    request.cache = folder_ / "banks";
    request.bank_missions = 20;
    return diagnose(request, [](std::string_view, double) {});
  }
  std::filesystem::path recorded(const std::string& name, std::string_view effects, std::uint64_t seed) {
    test::write_mission(folder_ / name, "identification", effects, 120, seed);
    return folder_ / name;
  }
  navcal::test::TemporaryFolder folder_;
};

const EffectFinding& found(const std::vector<EffectFinding>& findings, std::string_view name) {
  for (const EffectFinding& each : findings) {
    if (each.name == name) return each;
  }
  throw std::runtime_error("not found: " + std::string(name));
}

TEST_F(SeveralRecordings, GiveOneAnswerWithSmallerErrorsThanEachAlone) {
  const auto a = recorded("a.cap", kIron, 1), b = recorded("b.cap", kIron, 2), c = recorded("c.cap", kIron, 3);
  const Diagnosis together = diagnosis({a, b}, {c}), alone = diagnosis({a}, {c});
  ASSERT_EQ(together.verdict, Verdict::explained) << together.sentence;
  ASSERT_EQ(together.effects.size(), 1U);
  const EffectParameterEstimate& x = found(together.effects, "hard_iron").parameters.front();
  EXPECT_NEAR(x.value, 1.2, 4 * x.std_error);
  EXPECT_LT(x.std_error, found(alone.effects, "hard_iron").parameters.front().std_error);
  EXPECT_GT(together.duration_s, 1.9 * alone.duration_s);
  ASSERT_EQ(together.recordings.size(), 2U);
  EXPECT_EQ(together.recordings[1].recording, "b.cap");
  ASSERT_EQ(together.differences.size(), 1U);
  EXPECT_FALSE(together.differences.front().differs);
  EXPECT_TRUE(alone.recordings.empty());
}

TEST_F(SeveralRecordings, AreToldApartWhereAnEffectIsInOneOnly) {
  const Diagnosis answer = diagnosis({recorded("a.cap", kIron, 1), recorded("b.cap", "", 2)});
  EXPECT_EQ(answer.verdict, Verdict::unknown) << answer.sentence;
  ASSERT_EQ(answer.recordings.size(), 2U);
  ASSERT_TRUE(answer.recordings[0].alone && answer.recordings[1].alone);
  EXPECT_EQ(answer.recordings[0].alone->effects, std::vector<std::string>{"hard_iron"});
  EXPECT_TRUE(answer.recordings[1].alone->effects.empty());
  EXPECT_NE(answer.sentence.find("a.cap"), std::string::npos) << answer.sentence;
}

TEST_F(SeveralRecordings, CountOnceAndAreNotHeldOutAsWell) {
  const auto a = recorded("a.cap", "", 1), b = recorded("b.cap", "", 2);
  const auto twice = diagnosis({a, a});
  EXPECT_NE(std::find_if(twice.remarks.begin(), twice.remarks.end(),
                         [](const std::string& one) { return one.find("counts once") != std::string::npos; }),
            twice.remarks.end());
  EXPECT_THROW((void)diagnosis({a, b}, {b}), std::invalid_argument);
  EXPECT_THROW((void)diagnosis({}), std::invalid_argument);
}

}  // namespace
}  // namespace navcal::gap
