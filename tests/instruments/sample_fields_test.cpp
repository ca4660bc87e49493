// SPDX-License-Identifier: Apache-2.0
// The table of the members of samples, and the page that explains them.
#include "instruments/sample_fields.h"

#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <sstream>
#include <string>

namespace navcal::instruments {
namespace {

TEST(SampleFields, AKeyStandsOnceInItsKindAndOnThePageOfSamples) {
  std::ostringstream page;
  page << std::ifstream(NAVCAL_SOURCE_DIR "/docs/samples.md").rdbuf();
  for_each_kind([&]<class S>(std::type_identity<S>) {
    std::set<std::string_view> keys;
    for_each_field<S>([&](const auto& field) {
      EXPECT_TRUE(keys.insert(field.key).second) << field.key;
      EXPECT_NE(page.str().find("`" + std::string(field.key) + "`"), std::string::npos) << field.key;
    });
  });
}

TEST(SampleFields, BoundsAreThoseOfWhatComesFromOutside) {
  for_each_kind([&]<class S>(std::type_identity<S>) {
    for_each_field<S>([&]<class Owner, class T>(const kind::Field<Owner, T>& field) {
      const auto& [units, bounds, role, form] = field.quantity;
      constexpr bool kIsText = requires(T text) { text.view(); };
      const bool is_number = !std::is_same_v<T, bool> && !std::is_enum_v<T> && !kIsText && field.key != "error";
      EXPECT_EQ(bounds.max > bounds.min, is_number && role != Role::result) << field.key;
    });
  });
}

}  // namespace
}  // namespace navcal::instruments
