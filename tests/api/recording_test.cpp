// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <navcal/recording.h>

#include <map>
#include <utility>

#include "protocols/device_types.h"
#include "tests/api/api_program.h"
#include "tests/api/sample_fields.h"

namespace navcal::api::test {
namespace {

class ApiRecording : public ApiProgram {
 protected:
  static std::vector<Sample> samples_of(Recording& recording) {
    std::vector<Sample> samples;
    for (const Sample& sample : recording) samples.push_back(sample);
    return samples;
  }
  /// Empty when the library reads the file as `navcal replay` does.
  std::string difference_from_replay(const std::filesystem::path& name, const std::filesystem::path& config = {}) {
    Recording recording(name, config);
    const auto samples = samples_of(recording);
    const std::string option = config.empty() ? std::string() : " --config '" + config.string() + "'";
    return difference(samples, recording.ports(),
                      sample_lines(output_of("replay '" + name.string() + "'" + option)));
  }
};

/// A capture of one port: the bytes come in reads of `read_size`, 0.1 s apart.
std::string capture_of(const std::string& device, const std::string& bytes, std::size_t read_size) {
  std::string text = "#capture 1\n#port p " + device + " 9600\n";
  for (std::size_t i = 0; i < bytes.size(); i += read_size) {
    text += fmt::format("{}.{}00000000 p < ", 1'900'000'000 + i / read_size / 10, i / read_size % 10);
    for (const char c : bytes.substr(i, read_size)) text += fmt::format("{:02x}", static_cast<unsigned char>(c));
    text += '\n';
  }
  return text;
}

TEST_F(ApiRecording, SamplesOfACaptureAreThoseOfTheProgram) {
  const auto capture = swing("a.cap", 60);
  EXPECT_EQ(difference_from_replay(capture), "");
}

TEST_F(ApiRecording, SamplesOfALogAreThoseOfTheProgram) {
  (void)swing("a.cap", 60);
  (void)output_of("log import -o a.mcap a.cap");
  EXPECT_EQ(difference_from_replay(folder_ / "a.mcap"), "");
}

TEST_F(ApiRecording, SamplesOfEachDeviceAreThoseOfTheProgram) {
  std::map<std::size_t, int> kinds;
  for (const auto& device : protocols::kDeviceTypes) {
    const auto stream =
        std::filesystem::path(NAVCAL_SOURCE_DIR) / "fixtures/decode" / (std::string(device.name) + ".bin");
    if (!std::filesystem::exists(stream)) continue;
    const auto capture = file(std::string(device.name) + ".cap",
                              capture_of(std::string(device.name), navcal::test::read_file(stream), 50));
    EXPECT_EQ(difference_from_replay(capture), "") << device.name;
    for (const Sample& sample : Recording(capture))
      if (sample.port != Sample::kNoPort) ++kinds[sample.value.index()];
  }
  // All kinds but the two estimates, which no port makes.
  EXPECT_EQ(kinds.size(), std::variant_size_v<Measurement> - 2);
}

TEST_F(ApiRecording, AnotherConfigurationTakesThePlaceOfItsOwn) {
  const auto capture = swing("a.cap", 30);
  const auto config = file("c.toml",
                           "[battery]\nenabled = true\n[port.compass]\nprotocol = \"tcm2\"\npath = \"/dev/null\"\n"
                           "[port.motor]\nprotocol = \"motor-card\"\npath = \"/dev/zero\"\n");
  EXPECT_EQ(difference_from_replay(capture, config), "");
  Recording recording(capture, config);
  ASSERT_EQ(recording.ports().size(), 2U);
  EXPECT_EQ(recording.ports()[0].name, "compass");
  EXPECT_EQ(recording.ports()[1].device, "motor-card");
  ASSERT_FALSE(recording.remarks().empty());
  EXPECT_NE(recording.remarks()[0].find("port imu is not in the configuration"), std::string::npos);
  bool has_battery = false;
  for (const Sample& sample : recording) has_battery |= std::holds_alternative<BatterySample>(sample.value);
  EXPECT_TRUE(has_battery);
}

TEST_F(ApiRecording, ReadingMayPauseAndGoOnElsewhere) {
  const auto capture = swing("a.cap", 10);
  Recording whole(capture), moved(capture);
  const auto expected = samples_of(whole);
  EXPECT_FALSE(whole.next()) << "the end stays the end";
  EXPECT_DOUBLE_EQ(whole.progress(), 1);
  std::size_t read = 0;
  while (read < 100 && moved.next()) ++read;
  EXPECT_LT(moved.progress(), 1.0 + 1e-12);
  Recording other = std::move(moved);
  while (other.next()) ++read;
  EXPECT_EQ(read, expected.size());
}

TEST_F(ApiRecording, ABadFileIsAnErrorThatNamesIt) {
  const auto missing = error_of([&] { Recording(folder_ / "missing.cap"); });
  ASSERT_TRUE(missing);
  EXPECT_EQ(missing->kind, ErrorKind::bad_input);
  EXPECT_TRUE(missing->names("missing.cap")) << missing->message;
  for (const std::string content : {"", "garbage", "#capture 1\n#port p nothing 1\n", "\x89MCAP0\r\n"}) {
    const auto path = file("bad.cap", content);
    const auto error = error_of([&] {
      for (const Sample& sample : Recording(path)) (void)sample;
    });
    // An empty recording of no ports is one.
    if (!error) continue;
    EXPECT_EQ(error->kind, ErrorKind::bad_input) << content;
    EXPECT_TRUE(error->names("bad.cap")) << error->message;
  }
  const auto folder = error_of([&] { Recording(folder_.path()); });
  ASSERT_TRUE(folder);
  EXPECT_EQ(folder->kind, ErrorKind::bad_input);
  const auto config = error_of([&] { Recording(swing("a.cap", 1), folder_ / "missing.toml"); });
  ASSERT_TRUE(config);
  EXPECT_TRUE(config->names("missing.toml")) << config->message;
}

TEST_F(ApiRecording, ABadLineIsNamedAfterTheSamplesBeforeIt) {
  const auto capture = swing("a.cap", 5);
  std::ofstream(capture, std::ios::app) << "1900000000.000000000 nobody < 00\n1900000001.000000000 imu < 00\n";
  Recording recording(capture);
  std::size_t samples = 0;
  const auto error = error_of([&] {
    while (recording.next()) ++samples;
  });
  ASSERT_TRUE(error);
  EXPECT_GT(samples, 100U);
  EXPECT_TRUE(error->names("a.cap:")) << error->message;
}

}  // namespace
}  // namespace navcal::api::test
