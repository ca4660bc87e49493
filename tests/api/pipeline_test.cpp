// SPDX-License-Identifier: Apache-2.0
#include <navcal/pipeline.h>
#include <navcal/recording.h>

#include <algorithm>
#include <sstream>

#include "tests/api/api_program.h"
#include "tests/api/sample_fields.h"

namespace navcal::api::test {
namespace {

/// A read of a port, from a line of a capture.
struct Read {
  std::string port;
  std::int64_t time_ns = 0;
  std::vector<std::uint8_t> bytes;
};

std::vector<Read> reads_of(const std::string& capture) {
  std::vector<Read> reads;
  std::istringstream stream(capture);
  for (std::string line; std::getline(stream, line);) {
    if (line.starts_with('#')) continue;
    std::istringstream words(line);
    std::string stamp, port, direction, digits;
    words >> stamp >> port >> direction >> digits;
    if (direction != "<") continue;
    stamp.erase(stamp.find('.'), 1);
    Read read{port, std::stoll(stamp), {}};
    for (std::size_t i = 0; i + 1 < digits.size(); i += 2)
      read.bytes.push_back(static_cast<std::uint8_t>(std::stoi(digits.substr(i, 2), nullptr, 16)));
    reads.push_back(std::move(read));
  }
  return reads;
}

void append(std::vector<Sample>& samples, std::vector<Sample> more) {
  for (Sample& sample : more) samples.push_back(std::move(sample));
}

class ApiPipeline : public ApiProgram {
 protected:
  /// The samples of a capture whose bytes are pushed in pieces of at most `piece` bytes.
  static std::vector<Sample> pushed(Pipeline& pipeline, const std::vector<Read>& reads, std::size_t piece) {
    std::vector<Sample> samples;
    append(samples, pipeline.set_mapping({UtcSource::file, 0, 0, reads.front().time_ns}));
    for (const Read& read : reads) {
      const std::size_t port = pipeline.port(read.port);
      for (std::size_t at = 0; at < read.bytes.size(); at += piece) {
        const auto rest = std::span(read.bytes).subspan(at);
        append(samples, pipeline.push(port, read.time_ns, rest.first(std::min(piece, rest.size()))));
      }
    }
    append(samples, pipeline.advance(reads.back().time_ns));
    return samples;
  }
};

TEST_F(ApiPipeline, PushedBytesGiveTheSamplesOfTheProgram) {
  const auto capture = swing("a.cap", 30);
  const auto lines = sample_lines(output_of("replay a.cap"));
  const auto reads = reads_of(navcal::test::read_file(capture));
  for (const std::size_t piece : {std::size_t{4096}, std::size_t{7}}) {
    auto pipeline = Pipeline::from_text(Recording(capture).configuration());
    const auto samples = pushed(pipeline, reads, piece);
    EXPECT_EQ(difference(samples, pipeline.ports(), lines), "") << piece;
  }
}

TEST_F(ApiPipeline, EveryByteIsCounted) {
  const auto capture = swing("a.cap", 10);
  const auto reads = reads_of(navcal::test::read_file(capture));
  auto pipeline = Pipeline::from_text(Recording(capture).configuration());
  (void)pushed(pipeline, reads, 4096);
  std::vector<std::uint64_t> pushed_bytes(pipeline.ports().size());
  for (const Read& read : reads) pushed_bytes[pipeline.port(read.port)] += read.bytes.size();
  for (std::size_t port = 0; port < pushed_bytes.size(); ++port) {
    const PortCounters counters = pipeline.counters(port);
    EXPECT_EQ(counters.framed_bytes + counters.skipped_bytes + counters.held_bytes, pushed_bytes[port]) << port;
  }
}

TEST_F(ApiPipeline, MisuseIsAnError) {
  const std::string config = "[port.compass]\nprotocol = \"tcm2\"\npath = \"/dev/null\"\n";
  auto pipeline = Pipeline::from_text(config);
  const std::vector<std::uint8_t> bytes(10);
  const auto no_port = error_of([&] { (void)pipeline.push(1, 0, bytes); });
  ASSERT_TRUE(no_port);
  EXPECT_EQ(no_port->kind, ErrorKind::bad_argument);
  EXPECT_TRUE(no_port->names("port 1"));
  const auto no_name = error_of([&] { (void)pipeline.port("imu"); });
  ASSERT_TRUE(no_name);
  EXPECT_TRUE(no_name->names("port imu"));
  (void)pipeline.push(0, 1'000'000'000, bytes);
  (void)pipeline.push(0, 1'000'000'000, {});
  const auto backwards = error_of([&] { (void)pipeline.push(0, 999'999'999, bytes); });
  ASSERT_TRUE(backwards);
  EXPECT_EQ(backwards->kind, ErrorKind::bad_argument);
  EXPECT_TRUE(error_of([&] { (void)pipeline.advance(0); }));
  EXPECT_TRUE(error_of([&] { (void)pipeline.counters(1); }));
}

TEST_F(ApiPipeline, ABadConfigurationIsAnErrorThatNamesFileAndLine) {
  const auto error = error_of([] { (void)Pipeline::from_text("[port.p]\nprotocol = \"nothing\"\n", "my.toml"); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->kind, ErrorKind::bad_input);
  EXPECT_TRUE(error->names("my.toml:2")) << error->message;
  const auto missing = error_of([&] { (void)Pipeline::from_file(folder_ / "missing.toml"); });
  ASSERT_TRUE(missing);
  EXPECT_TRUE(missing->names("missing.toml")) << missing->message;
}

}  // namespace
}  // namespace navcal::api::test
