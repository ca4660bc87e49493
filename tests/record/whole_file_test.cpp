// SPDX-License-Identifier: Apache-2.0
#include "record/whole_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <array>
#include <fstream>
#include <iterator>

#include "base/descriptor.h"
#include "tests/support/temporary_folder.h"

namespace navcal::record {
namespace {

namespace fs = std::filesystem;

class WrittenWhole : public ::testing::Test {
 protected:
  static void write(const fs::path& file, std::string_view content) {
    WholeFile whole(file);
    whole.write(content);
    whole.commit();
  }
  [[nodiscard]] long files() const {
    return std::distance(fs::directory_iterator(folder_.path()), fs::directory_iterator());
  }

  navcal::test::TemporaryFolder folder_;
};

TEST_F(WrittenWhole, HasItsNameOnlyWhenItIsWhole) {
  const fs::path file = folder_ / "a.json";
  std::ofstream(file) << "before";
  {
    WholeFile whole(file);
    whole.write("half");
    EXPECT_EQ(navcal::test::read_file(file), "before");
  }
  EXPECT_EQ(navcal::test::read_file(file), "before");
  EXPECT_EQ(files(), 1);
  write(file, "after");
  EXPECT_EQ(navcal::test::read_file(file), "after");
  EXPECT_EQ(files(), 1);
}

// A file in its place would be the end of the device for every other program.
TEST_F(WrittenWhole, APipeStaysAPipeAndIsWrittenTo) {
  const fs::path pipe = folder_ / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const base::Descriptor reader(::open(pipe.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
  ASSERT_TRUE(is_written_in_place(pipe));
  write(pipe, "through");
  std::array<char, 16> bytes{};
  EXPECT_EQ(::read(reader.get(), bytes.data(), bytes.size()), 7);
  EXPECT_TRUE(fs::is_fifo(pipe));
  EXPECT_EQ(files(), 1);
  { const WholeFile left_half_way(pipe); }
  EXPECT_TRUE(fs::is_fifo(pipe));
}

TEST_F(WrittenWhole, ALinkKeepsItsPlaceAndItsTargetIsReplaced) {
  fs::create_directory(folder_ / "elsewhere");
  const fs::path target = folder_ / "elsewhere/a.json";
  std::ofstream(target) << "before";
  const fs::path link = folder_ / "link.json";
  fs::create_symlink("elsewhere/a.json", link);
  write(link, "after");
  EXPECT_TRUE(fs::is_symlink(link));
  EXPECT_EQ(navcal::test::read_file(target), "after");
  fs::remove(target);
  write(link, "no target");
  EXPECT_EQ(navcal::test::read_file(link), "no target");
}

TEST_F(WrittenWhole, OrdinaryFilesAndDevices) {
  EXPECT_TRUE(is_written_in_place("/dev/null"));
  EXPECT_TRUE(is_written_in_place("/dev/stdout"));
  EXPECT_TRUE(is_written_in_place("/proc/self/fd/1"));
  EXPECT_FALSE(is_written_in_place(folder_ / "new"));
  EXPECT_FALSE(is_written_in_place("/dev/shm/new.json")) << "a folder of ordinary files";
  EXPECT_FALSE(is_written_in_place(folder_.path()));
  EXPECT_THROW(write(folder_.path(), "a folder"), std::system_error);
}

}  // namespace
}  // namespace navcal::record
