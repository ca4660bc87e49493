// SPDX-License-Identifier: Apache-2.0
#include "gap/nulls/bank_cache.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>

#include "tests/gap/nulls/made_up_bank.h"
#include "tests/gap/simulated_mission.h"
#include "tests/support/temporary_folder.h"

namespace navcal::gap {
namespace {

class BankCacheTest : public testing::Test {
 protected:
  BankCacheTest() : mission_(test::simulated_mission("identification", "", 60, 1)), replay_(mission_, {}) {
    (void)replay_.run({}, &course_);
  }
  navcal::test::TemporaryFolder folder_;
  Library library_{{}};
  NullBank bank_ = test::made_up_bank(static_cast<Eigen::Index>(library_.unknowns().size()));
  Mission mission_;
  Replay replay_;
  Trajectory10Hz course_;
};

TEST_F(BankCacheTest, GivesBackWhatItWasGiven) {
  const BankCache cache(folder_ / "banks", {}, library_);
  EXPECT_FALSE(cache.find(replay_, course_, {20, 1, 1}));
  EXPECT_EQ(cache.keep(replay_, course_, bank_), "");
  const auto found = cache.find(replay_, course_, {20, 1, 1});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->scores, bank_.scores);
  EXPECT_EQ(found->powers, bank_.powers);
  EXPECT_EQ(found->whitening.grid_factor, bank_.whitening.grid_factor);
}

TEST_F(BankCacheTest, AnotherSeedVehicleSizeOrMissionNeedsAnother) {
  const BankCache cache(folder_.path(), {}, library_);
  EXPECT_EQ(cache.keep(replay_, course_, bank_), "");
  EXPECT_FALSE(cache.find(replay_, course_, {20, 2, 1}));
  EXPECT_FALSE(cache.find(replay_, course_, {100, 1, 1}));
  config::VehicleSettings heavier;
  heavier.hull.mass_kg *= 1.1;
  EXPECT_FALSE(BankCache(folder_.path(), heavier, library_).find(replay_, course_, {20, 1, 1}));
  const Mission other = test::simulated_mission("thesis1", "", 60, 1);
  const Replay replay(other, {});
  Trajectory10Hz course;
  (void)replay.run({}, &course);
  EXPECT_FALSE(cache.find(replay, course, {20, 1, 1}));
}

TEST_F(BankCacheTest, OtherInstrumentsNeedAnother) {
  const BankCache cache(folder_.path(), {}, library_);
  EXPECT_EQ(cache.keep(replay_, course_, bank_), "");
  const auto is_found_with = [&](const devices::InstrumentModel& instruments) {
    Mission mission = mission_;
    mission.instruments = instruments;
    return cache.find(Replay(mission, {}), course_, {20, 1, 1}).has_value();
  };
  EXPECT_TRUE(is_found_with({}));
  devices::InstrumentModel noisier, later, scaled;
  noisier.compass.field_noise_uT *= 1.01;
  later.imu.timing.latency_s += 0.001;
  scaled.imu.channels.scale[7] *= 1.01;
  for (const auto& instruments : {noisier, later, scaled}) EXPECT_FALSE(is_found_with(instruments));
}

TEST_F(BankCacheTest, InstrumentsThatAreSilentNeedAnother) {
  const BankCache cache(folder_.path(), {}, library_);
  EXPECT_EQ(cache.keep(replay_, course_, bank_), "");
  const auto is_found_without = [&](std::initializer_list<const char*> names) {
    Mission mission = mission_;
    for (const char* const name : names) leave_out(quantities_named(name), mission);
    return cache.find(Replay(mission, {}), course_, {20, 1, 1}).has_value();
  };
  EXPECT_TRUE(is_found_without({}));
  for (const char* const name : {"compass", "tilt", "card", "depth"})
    EXPECT_FALSE(is_found_without({name})) << name;
}

TEST_F(BankCacheTest, TheSameMissionOnceMoreIsServed) {
  const BankCache cache(folder_.path(), {}, library_);
  EXPECT_EQ(cache.keep(replay_, course_, bank_), "");
  const Mission again = test::simulated_mission("identification", "[hard_iron]\nx_uT = 2\n", 60, 9);
  const Replay replay(again, {});
  Trajectory10Hz course;
  (void)replay.run({}, &course);
  EXPECT_TRUE(cache.find(replay, course, {20, 1, 1}));
}

TEST_F(BankCacheTest, AnotherFieldOfTheEarthNeedsAnother) {
  const BankCache cache(folder_.path(), {}, library_);
  EXPECT_EQ(cache.keep(replay_, course_, bank_), "");
  mission_.field.north_east_down_uT[0] += 0.2;
  EXPECT_TRUE(cache.find(replay_, course_, {20, 1, 1}));
  mission_.field.north_east_down_uT[0] += 1;
  EXPECT_FALSE(cache.find(replay_, course_, {20, 1, 1}));
  mission_.field.north_east_down_uT[0] -= 1;
  mission_.field.source = EarthField::Source::fitted;
  EXPECT_FALSE(cache.find(replay_, course_, {20, 1, 1}));
}

TEST_F(BankCacheTest, AFolderThatCannotBeMadeIsToldAndNoMore) {
  std::ofstream(folder_ / "file") << "in the way";
  const BankCache cache(folder_ / "file" / "banks", {}, library_);
  EXPECT_NE(cache.keep(replay_, course_, bank_), "");
  EXPECT_FALSE(cache.find(replay_, course_, {20, 1, 1}));
}

TEST_F(BankCacheTest, FilesThatAreNoBanksArePassedOver) {
  const BankCache cache(folder_.path(), {}, library_);
  EXPECT_EQ(cache.keep(replay_, course_, bank_), "");
  std::filesystem::path bank;
  for (const auto& file : std::filesystem::directory_iterator(folder_.path())) bank = file.path();
  std::ifstream stream(bank);
  const std::string whole((std::istreambuf_iterator<char>(stream)), {});
  std::filesystem::remove(bank);
  for (const std::string& text : {std::string(), std::string("{"), std::string("[]"), std::string("{\"model\":3}"),
                                  whole.substr(0, whole.size() / 2), std::string(100, '\0')}) {
    std::ofstream(folder_ / "null-bank-bad.json") << text;
    EXPECT_FALSE(cache.find(replay_, course_, {20, 1, 1}));
  }
}

TEST_F(BankCacheTest, KeepsTheBanksUsedLastAndNoMoreThanItsLimit) {
  const BankCache cache(folder_.path(), {}, library_);
  EXPECT_EQ(cache.keep(replay_, course_, bank_), "");
  const auto now = std::filesystem::file_time_type::clock::now();
  for (const auto& file : std::filesystem::directory_iterator(folder_.path()))
    std::filesystem::last_write_time(file.path(), now - std::chrono::hours(1000));
  std::ofstream(folder_ / "notes.txt") << "not a bank";
  const auto made_up = [&](std::size_t i) {
    return folder_ / ("null-bank-" + std::to_string(10'000'000 + i) + ".json");
  };
  for (std::size_t i = 0; i < BankCache::kMostBanks; ++i) {
    std::ofstream(made_up(i)) << "an old bank";
    std::filesystem::last_write_time(made_up(i), now - std::chrono::hours(i + 1));
  }
  EXPECT_TRUE(cache.find(replay_, course_, {20, 1, 1}));  // it counts as used now
  bank_.seed = 2;
  EXPECT_EQ(cache.keep(replay_, course_, bank_), "");
  EXPECT_TRUE(cache.find(replay_, course_, {20, 1, 1}));
  EXPECT_TRUE(cache.find(replay_, course_, {20, 2, 1}));
  EXPECT_TRUE(std::filesystem::exists(made_up(BankCache::kMostBanks - 3)));
  EXPECT_FALSE(std::filesystem::exists(made_up(BankCache::kMostBanks - 2)));
  EXPECT_FALSE(std::filesystem::exists(made_up(BankCache::kMostBanks - 1)));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "notes.txt"));
}

}  // namespace
}  // namespace navcal::gap
