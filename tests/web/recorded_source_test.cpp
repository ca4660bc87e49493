// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <boost/asio/io_context.hpp>
#include <fstream>
#include <nlohmann/json.hpp>

#include "record/log/mcap_format.h"
#include "record/recording.h"
#include "tests/record/sample_log.h"
#include "tests/support/temporary_folder.h"
#include "web/viewer.h"

namespace navcal::web {
namespace {

struct Heard final : Subscriber {
  void on_record(const Record& record) override {
    topics.emplace_back(record.topic);
    devices.emplace_back(record.device);
    times_ns.push_back(record.utc_ns);
    texts.emplace_back(record.message);
  }
  void on_forget() override { ++forgotten; }
  [[nodiscard]] std::size_t count(std::string_view topic) const {
    return static_cast<std::size_t>(std::count(topics.begin(), topics.end(), topic));
  }
  void clear() { *this = Heard{}; }
  std::vector<std::string> topics, devices, texts;
  std::vector<std::optional<std::int64_t>> times_ns;
  int forgotten = 0;
};

class RecordedSourceTest : public ::testing::Test {
 protected:
  std::filesystem::path write(std::string_view bytes, const std::string& name = "a.mcap") {
    std::ofstream(folder / name, std::ios::binary) << bytes;
    return folder / name;
  }
  std::shared_ptr<RecordedSource> open(double speed = 1) {
    const auto file = write(record::testing::sample_log(10, true).bytes);
    const auto source =
        std::make_shared<RecordedSource>(context.get_executor(), hub, RecordedLog(file, {}), "a.mcap", speed);
    hub.add(heard, {});
    source->viewer_came();
    return source;
  }
  static nlohmann::json state(const RecordedSource& source) {
    std::string text;
    source.append_state(text);
    return nlohmann::json::parse(text);
  }

  navcal::test::TemporaryFolder folder;
  boost::asio::io_context context;
  Hub hub;
  Heard heard;
};

TEST_F(RecordedSourceTest, EveryMessageOnceAndInOrder) {
  const auto source = open();
  for (int i = 0; i < 1000; ++i) source->advance(std::chrono::milliseconds(20));
  EXPECT_EQ(heard.count("/imu"), 200U);
  EXPECT_EQ(heard.count("/compass"), 100U);
  EXPECT_EQ(heard.count("/event"), 10U);
  EXPECT_EQ(heard.count("/config"), 0U);
  EXPECT_EQ(heard.count("/raw/imu"), 0U);
  EXPECT_FALSE(source->playing());
  std::optional<std::int64_t> last_ns;
  for (std::size_t i = 0; i < heard.topics.size(); ++i) {
    if (heard.topics[i] != "/imu") continue;
    EXPECT_EQ(heard.devices[i], "imu");
    ASSERT_TRUE(heard.times_ns[i]);
    EXPECT_GT(*heard.times_ns[i], last_ns.value_or(0));
    last_ns = heard.times_ns[i];
  }
}

TEST_F(RecordedSourceTest, MessagesAreThoseOfTheLog) {
  const auto source = open();
  source->advance(std::chrono::seconds(1));
  for (const auto& text : heard.texts) {
    ASSERT_TRUE(nlohmann::json::accept(text)) << text;
    EXPECT_TRUE(nlohmann::json::parse(text).contains("crc"));
  }
}

TEST_F(RecordedSourceTest, PlaysAtItsSpeed) {
  const auto source = open(2);
  source->advance(std::chrono::seconds(1));
  EXPECT_NEAR(source->position_s(), 2, 1e-9);
  source->command(R"({"speed":0.5})");
  source->advance(std::chrono::seconds(1));
  EXPECT_NEAR(source->position_s(), 2.5, 1e-9);
  source->command(R"({"play":false})");
  source->advance(std::chrono::seconds(1));
  EXPECT_NEAR(source->position_s(), 2.5, 1e-9);
  EXPECT_NEAR(source->duration_s(), 9.95, 0.06);
  EXPECT_EQ(state(*source)["playing"], false);
  EXPECT_EQ(state(*source)["file"], "a.mcap");
}

TEST_F(RecordedSourceTest, BeginsWhenSomebodyWatches) {
  const auto file = write(record::testing::sample_log(2, true).bytes);
  RecordedSource source(context.get_executor(), hub, RecordedLog(file, {}), "a", 1);
  source.advance(std::chrono::seconds(1));
  EXPECT_EQ(source.position_s(), 0);
  source.viewer_came();
  source.advance(std::chrono::seconds(1));
  EXPECT_EQ(source.position_s(), 1);
}

TEST_F(RecordedSourceTest, SeekingTellsWhatWasNewestThere) {
  const auto source = open();
  source->command(R"({"seek":5})");
  EXPECT_EQ(heard.forgotten, 1);
  EXPECT_NEAR(source->position_s(), 5, 1e-9);
  EXPECT_EQ(heard.count("/event"), 5U);
  EXPECT_EQ(heard.count("/imu"), 32U);
  heard.clear();
  source->advance(std::chrono::seconds(1));
  EXPECT_EQ(heard.count("/imu"), 20U);
  heard.clear();
  source->command(R"({"seek":1})");
  EXPECT_EQ(heard.forgotten, 1);
  EXPECT_EQ(heard.count("/imu"), 21U);
}

TEST_F(RecordedSourceTest, AtAGreatSpeedEventsAreNotLeftOut) {
  const auto file = write(record::testing::sample_log(300, true).bytes);
  RecordedSource source(context.get_executor(), hub, RecordedLog(file, {}), "a", 1e6);
  hub.add(heard, {});
  source.viewer_came();
  source.advance(std::chrono::seconds(1));
  EXPECT_EQ(heard.count("/event"), 300U);
  EXPECT_LT(heard.count("/imu"), 1000U);
  EXPECT_GT(heard.count("/imu"), 100U);
}

TEST_F(RecordedSourceTest, AtTheEndPlayBeginsAgain) {
  const auto source = open();
  source->advance(std::chrono::hours(1));
  EXPECT_FALSE(source->playing());
  source->command(R"({"play":true})");
  EXPECT_TRUE(source->playing());
  EXPECT_EQ(source->position_s(), 0);
}

TEST_F(RecordedSourceTest, NonsenseChangesNothing) {
  const auto source = open();
  for (const char* const nonsense :
       {"", "{", "[]", "5", R"({"play":5})", R"({"seek":"x"})", R"({"speed":null})", R"({"seek":-5})"})
    source->command(nonsense);
  source->command(R"({"seek":1e300})");
  EXPECT_NEAR(source->position_s(), source->duration_s(), 1e-6);
  source->command(R"({"speed":-1})");
  EXPECT_EQ(source->speed(), RecordedSource::kLeastSpeed);
  source->command(R"({"speed":1e300})");
  EXPECT_EQ(source->speed(), RecordedSource::kGreatestSpeed);
}

TEST_F(RecordedSourceTest, UnfinishedAndDamagedLogsArePlayedAsFarAsTheyGo) {
  auto bytes = record::testing::sample_log(10, false).bytes;
  bytes.resize(bytes.size() - 7);
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 0x55);
  const RecordedLog log(write(bytes), {});
  EXPECT_GT(log.entries().size(), 300U);
  EXPECT_FALSE(log.remarks().empty());
}

TEST_F(RecordedSourceTest, SaysWhatIsWrongWithAFile) {
  const auto why = [](const std::filesystem::path& file) {
    try {
      const RecordedLog log(file, {});
    } catch (const record::BadRecording& error) {
      return std::string(error.what());
    }
    return std::string("(taken)");
  };
  const auto text = write("this is a text\n", "a.txt");
  EXPECT_NE(why(text).find(text.string()), std::string::npos) << why(text);
  const auto empty = write(record::empty_log_head(), "empty.mcap");
  EXPECT_NE(why(empty).find("no messages"), std::string::npos) << why(empty);
  EXPECT_NE(why(folder / "none.mcap").find("none.mcap"), std::string::npos);
}

}  // namespace
}  // namespace navcal::web
