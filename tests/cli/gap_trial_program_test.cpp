// SPDX-License-Identifier: Apache-2.0
// A small trial with everything real: the second reality makes the recordings, `navcal gap` answers. How often it
// is right only a large trial can say (docs/gap.md); here nothing may be named that is not there, and what was
// sealed must be what was asked.
#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "record/content_hash.h"
#include "tests/support/process.h"

namespace navcal::cli {
namespace {

TEST(GapTrialProgram, NamesNothingThatIsNotThereAndAnswersEveryCase) {
  const navcal::test::TemporaryFolder folder;
  ::setenv("XDG_CACHE_HOME", folder.path().c_str(), 1);
  navcal::test::Process trial(
      {NAVCAL_PROGRAM, "gap", "trial", "--arms", "nulls,single-1,single-2", "--cases", "4", "--minutes", "3",
       "--places", "1", "--bank", "40", "--seed", "1903", "--json", folder / "trial.json"},
      folder / "trial");
  const auto status = trial.wait(std::chrono::seconds(280));
  ::unsetenv("XDG_CACHE_HOME");
  ASSERT_TRUE(status) << "still running; it said\n" << trial.err();
  ASSERT_EQ(*status, 0) << trial.err();
  const auto json = nlohmann::json::parse(navcal::test::read_file(folder / "trial.json"));
  ASSERT_EQ(json["cases"].size(), 4U);
  int named = 0;
  for (const auto& one : json["cases"]) {
    EXPECT_FALSE(one.contains("failure")) << one["failure"];
    EXPECT_NE(one["outcome"], "wrong name") << one["truth"] << one["answer"];
    EXPECT_EQ(record::sha256_of(one["truth"].get<std::string>() + one["salt"].get<std::string>()), one["sha256"]);
    named += one["outcome"] == "exact";
  }
  EXPECT_GE(named, 1) << "not one effect was found";
}

}  // namespace
}  // namespace navcal::cli
