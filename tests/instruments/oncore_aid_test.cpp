// SPDX-License-Identifier: Apache-2.0
#include "instruments/oncore_aid.h"

#include <gtest/gtest.h>

#include "protocols/oncore_encode.h"

namespace navcal::instruments {
namespace {

namespace oncore = protocols::oncore;

constexpr std::int64_t kSecond_ns = 1'000'000'000;

class OncoreAidTest : public testing::Test {
 protected:
  void hear(bool cold, protocols::Fix fix = protocols::Fix::acquiring, protocols::FrameId id = oncore::kHa) {
    oncore::Position position;
    position.date = {2026, 1, 1};
    position.fix = fix;
    position.no_almanac = cold;
    const auto bytes = id == oncore::kHa ? oncore::encode_ha(position) : oncore::encode_ea(position);
    now_ns_ += kSecond_ns;
    aid_.on_frame({.id = id, .bytes = bytes}, now_ns_);
  }
  OncoreAid aid_;
  std::int64_t now_ns_ = 0;
};

TEST_F(OncoreAidTest, IsWantedInAColdStartAndGivenOnce) {
  EXPECT_FALSE(aid_.wanted());
  hear(true);
  ASSERT_TRUE(aid_.wanted());
  const auto commands = aid_.give({{37, -80, 0}, 1'764'000'000 * kSecond_ns});
  ASSERT_EQ(commands.size(), 2U);
  EXPECT_TRUE(oncore::parse_aid_time(commands[0]));
  EXPECT_TRUE(oncore::parse_aid_position(commands[1]));
  EXPECT_FALSE(aid_.wanted());
  hear(true);
  EXPECT_FALSE(aid_.wanted()) << "it takes its time";
}

TEST_F(OncoreAidTest, AWarmReceiverOrOneWithAFixIsLeftAlone) {
  hear(false);
  EXPECT_FALSE(aid_.wanted());
  hear(false, protocols::Fix::fix_3d);
  hear(true);
  EXPECT_FALSE(aid_.wanted()) << "it had a fix";
}

TEST_F(OncoreAidTest, APauseOrANewPortBeginsAnew) {
  hear(false, protocols::Fix::fix_3d);
  now_ns_ += 5 * kSecond_ns;
  hear(true);
  EXPECT_TRUE(aid_.wanted());
  hear(true, protocols::Fix::fix_2d);
  EXPECT_FALSE(aid_.wanted());
  aid_.begin();
  hear(true);
  EXPECT_TRUE(aid_.wanted());
}

TEST_F(OncoreAidTest, EightChannelsAreNotAided) {
  hear(true, protocols::Fix::acquiring, oncore::kEa);
  EXPECT_FALSE(aid_.wanted());
}

}  // namespace
}  // namespace navcal::instruments
