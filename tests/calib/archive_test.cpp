// SPDX-License-Identifier: Apache-2.0
#include "calib/archive.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <new>

#include "calib/turn/sampled_curve.h"
#include "calib/turn/turn_integrator.h"

namespace navcal::calib {
namespace {

struct Inner {
  double value = 0;
  void archive(Archive& archive) { archive(value); }
};

struct Everything {
  double real = 0;
  std::uint64_t count = 0;
  bool flag = false;
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
  std::optional<double> maybe, never;
  std::array<int, 3> numbers{};
  std::vector<Inner> list;
  std::string text;

  void archive(Archive& archive) {
    archive.tag("everything 1");
    archive(real, count, flag, matrix, maybe, never, numbers, list, text);
  }
};

Everything sample() {
  Everything e;
  e.real = -std::numeric_limits<double>::denorm_min();
  e.count = UINT64_MAX;
  e.flag = true;
  e.matrix << 1, 2, 3, 4, 5, 6, 7, 8, 9.5;
  e.maybe = 0.1;
  e.numbers = {3, -4, 5};
  e.list = {{1.5}, {std::numeric_limits<double>::infinity()}};
  e.text = std::string("a\0b", 3);
  return e;
}

std::string saved(Everything e) {
  Archive archive;
  archive(e);
  return archive.bytes();
}

TEST(Archive, RestoresEveryKindOfMemberExactly) {
  const std::string bytes = saved(sample());
  Everything back;
  back.never = 3;
  Archive archive{std::string_view(bytes)};
  archive(back);
  EXPECT_TRUE(archive.ok());
  EXPECT_TRUE(archive.at_end());
  EXPECT_EQ(saved(back), bytes);
  EXPECT_EQ(back.matrix, sample().matrix);
  EXPECT_FALSE(back.never.has_value());
}

TEST(Archive, CutAnywhereItFails) {
  const std::string bytes = saved(sample());
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    Everything back;
    Archive archive{std::string_view(bytes).substr(0, length)};
    archive(back);
    EXPECT_FALSE(archive.ok()) << length;
  }
}

TEST(Archive, ABoolThatIsNeitherFails) {
  bool flag = true;
  Archive archive{std::string_view("\2")};
  archive(flag);
  EXPECT_FALSE(archive.ok());
  EXPECT_TRUE(flag);
}

TEST(Archive, AnotherLayoutFails) {
  Archive saving;
  saving.tag("everything 2");
  Everything back;
  Archive archive{std::string_view(saving.bytes())};
  archive(back);
  EXPECT_FALSE(archive.ok());
}

TEST(Archive, AnAbsurdLengthAsksForNoMemory) {
  Archive saving;
  std::uint64_t size = UINT64_MAX;
  saving(size);
  std::vector<double> list;
  Archive archive{std::string_view(saving.bytes())};
  archive(list);
  EXPECT_FALSE(archive.ok());
  EXPECT_TRUE(list.empty());
}

/// The state of an object that was made where memory held `fill`.
template <class T, class... Arguments>
std::string state_over(unsigned char fill, const Arguments&... arguments) {
  alignas(T) std::array<unsigned char, sizeof(T)> memory;
  memory.fill(fill);
  T* const object = new (memory.data()) T(arguments...);
  Archive archive;
  object->archive(archive);
  object->~T();
  return archive.bytes();
}

TEST(Archive, TheStateIsTheObjectsAndNotWhatMemoryHeldBefore) {
  EXPECT_EQ(state_over<SampledCurve<4>>(0xA5), state_over<SampledCurve<4>>(0x5A));
  const TurnIntegrator::Parameters parameters;
  EXPECT_EQ(state_over<TurnIntegrator>(0xA5, parameters), state_over<TurnIntegrator>(0x5A, parameters));
}

TEST(Archive, RoomForWhatIsSavedChangesNothing) {
  std::vector<double> values(1000, 1.5);
  Archive plain, with_room(1 << 20);
  plain(values);
  with_room(values);
  EXPECT_EQ(plain.bytes(), with_room.bytes());
  EXPECT_EQ(std::move(with_room).take(), plain.bytes());
}

}  // namespace
}  // namespace navcal::calib
