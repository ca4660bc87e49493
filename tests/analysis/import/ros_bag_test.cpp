// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <lz4frame.h>
#include <zstd.h>

#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <numbers>
#include <tuple>

#include "analysis/import/log_readers.h"
#include "record/log/checksum.h"
#include "record/log/mcap_format.h"
#include "record/recording.h"
#include "tests/analysis/import/channel_map.h"
#include "tests/analysis/import/counts_agree.h"
#include "tests/analysis/import/recording_sink.h"
#include "tests/analysis/import/without_channels.h"

namespace navcal::analysis {
namespace {

using record::append_le;
using record::append_mcap_string;
using record::Opcode;
using record::RecordScope;
using testing::expect_vector;
using testing::RecordingSink;

constexpr std::uint64_t kLogged_ns = 1'700'000'000'500'000'000;

/// A message in CDR, little-endian, as rmw_fastrtps writes it.
class Cdr {
 public:
  Cdr() : out("\x00\x01\x00\x00", 4) {}
  template <class T>
  Cdr& put(T value) {
    while ((out.size() - 4) % sizeof(T) != 0) out.push_back('\0');
    testing::append_number(out, value);
    return *this;
  }
  template <std::size_t N>
  Cdr& put(const std::array<double, N>& values) {
    for (const double value : values) put(value);
    return *this;
  }
  /// Header of frame "imu_link" with a stamp half a second before the message was logged.
  Cdr& header() {
    put(std::int32_t{1'700'000'000}).put(std::uint32_t{7}).put(std::uint32_t{9});
    out += std::string("imu_link\0", 9);
    return *this;
  }
  std::string out;
};

std::string compressed(const std::string& bytes, const std::string& compression) {
  std::string out(2 * bytes.size() + 1024, '\0');
  if (compression == "lz4") {
    // As some writers do: blocks that refer to those before, and sums.
    LZ4F_preferences_t linked{};
    linked.frameInfo.blockMode = LZ4F_blockLinked;
    linked.frameInfo.contentChecksumFlag = LZ4F_contentChecksumEnabled;
    out.resize(LZ4F_compressFrame(out.data(), out.size(), bytes.data(), bytes.size(), &linked));
  } else if (compression == "zstd") {
    out.resize(ZSTD_compress(out.data(), out.size(), bytes.data(), bytes.size(), 3));
  } else {
    return bytes;
  }
  return out;
}

class BagWriter {
 public:
  BagWriter() {
    out = record::kMcapMagic;
    RecordScope record(out, Opcode::header);
    append_mcap_string(out, "ros2");
    append_mcap_string(out, "libmcap 1.0");
  }
  void topic(std::string& to, std::uint16_t id, const std::string& name, const std::string& type) {
    {
      RecordScope record(to, Opcode::schema);
      append_le(to, id);
      append_mcap_string(to, type);
      append_mcap_string(to, "ros2msg");
      append_mcap_string(to, "");
    }
    RecordScope record(to, Opcode::channel);
    append_le(to, id);
    append_le(to, id);
    append_mcap_string(to, name);
    append_mcap_string(to, "cdr");
    append_mcap_string(to, "");
  }
  static void message(std::string& to, std::uint16_t channel, const std::string& cdr) {
    RecordScope record(to, Opcode::message);
    append_le(to, channel);
    append_le(to, std::uint32_t{0});
    append_le(to, kLogged_ns);
    append_le(to, kLogged_ns);
    to += cdr;
  }
  void chunk(const std::string& records, const std::string& compression) {
    chunk(records.size(), 0, compression, compressed(records, compression));
  }
  void chunk(std::uint64_t size, std::uint32_t sum, const std::string& compression, const std::string& bytes) {
    RecordScope record(out, Opcode::chunk);
    append_le(out, kLogged_ns);
    append_le(out, kLogged_ns);
    append_le(out, size);
    append_le(out, sum);
    append_mcap_string(out, compression);
    append_le(out, std::uint64_t{bytes.size()});
    out += bytes;
  }
  /// `summary`: records of types and channels.
  std::string finished(const std::string& summary = "") {
    {
      RecordScope record(out, Opcode::data_end);
      append_le(out, std::uint32_t{0});
    }
    const std::uint64_t start = summary.empty() ? 0 : out.size();
    out += summary;
    {
      RecordScope record(out, Opcode::footer);
      append_le(out, start);
      out.append(record::kFooterLength - sizeof start, '\0');
    }
    return out + std::string(record::kMcapMagic);
  }
  std::string out;
};

constexpr std::array<double, 9> kVariance{0.04, 0, 0, 0, 0.04, 0, 0, 0, 0.09};

std::string imu_message() {
  Cdr imu;
  imu.header();
  // A quarter turn to port (about the axis that points up): from east to north.
  imu.put(std::array<double, 4>{0, 0, std::numbers::sqrt2 / 2, std::numbers::sqrt2 / 2}).put(kVariance);
  imu.put(std::array<double, 3>{0.5, 0.25, -0.125}).put(kVariance);
  return imu.put(std::array<double, 3>{0.5, -1, 9.75}).put(kVariance).out;
}

std::string small_bag(const std::string& compression = "") {
  BagWriter bag;
  std::string inside;
  bag.topic(inside, 1, "/imu/data", "sensor_msgs/msg/Imu");
  bag.topic(inside, 2, "/imu/mag", "sensor_msgs/msg/MagneticField");
  bag.topic(inside, 3, "/fix", "sensor_msgs/msg/NavSatFix");
  bag.topic(inside, 4, "/pressure", "sensor_msgs/msg/FluidPressure");
  bag.topic(inside, 5, "/dvl", "geometry_msgs/msg/TwistWithCovarianceStamped");
  bag.topic(inside, 6, "/water", "sensor_msgs/msg/Temperature");
  bag.topic(inside, 7, "/camera", "sensor_msgs/msg/Image");
  BagWriter::message(inside, 1, imu_message());
  BagWriter::message(inside, 2, Cdr().header().put(std::array<double, 3>{20e-6, 5e-6, -43e-6}).put(kVariance).out);
  BagWriter::message(inside, 3,
                     Cdr()
                         .header()
                         .put(std::int8_t{0})
                         .put(std::uint16_t{1})
                         .put(std::array<double, 3>{47.5, -122.5, 12.5})
                         .put(kVariance)
                         .put(std::uint8_t{2})
                         .out);
  BagWriter::message(inside, 4, Cdr().header().put(135'000.0).put(0.0).out);
  BagWriter::message(inside, 5,
                     Cdr()
                         .header()
                         .put(std::array<double, 3>{1, 0.5, -0.25})
                         .put(std::array<double, 3>{})
                         .put(std::array<double, 36>{0.01, 0, 0, 0, 0, 0, 0, 0.01})
                         .out);
  BagWriter::message(inside, 6, Cdr().header().put(8.25).put(0.0).out);
  BagWriter::message(inside, 7, Cdr().header().out);
  bag.chunk(inside, compression);
  return bag.finished();
}

TEST(RosBag, AxesOfRep103BecomeThoseOfNavcal) {
  ASSERT_TRUE(is_ros_bag(small_bag()));
  RecordingSink sink;
  const auto findings = read_ros_bag(small_bag(), sink);
  EXPECT_TRUE(findings.times_are_utc);
  EXPECT_FALSE(findings.cut_at);
  const auto imu = sink.of_port("imu").at(0);
  EXPECT_EQ(imu.message, "/imu/data");
  EXPECT_EQ(imu.time_ns, static_cast<std::int64_t>(kLogged_ns));
  EXPECT_EQ(imu.utc_ns, 1'700'000'000'000'000'007);
  expect_vector(imu.line["rate_rad_s"], 0.5, -0.25, 0.125);
  expect_vector(imu.line["specific_force_m_s2"], 0.5, 1, -9.75);
  EXPECT_NEAR(imu.line["rate_std_rad_s"].get<double>(), 0.2, 1e-12);
  const auto attitude = sink.of_port("attitude").at(0);
  EXPECT_NEAR(attitude.line["heading_rad"].get<double>(), 0, 1e-9) << "north";
  expect_vector(sink.of_port("compass").at(0).line["field_body_uT"], 20, -5, 43, 1e-9);
  const auto fix = sink.of_port("gps").at(0);
  EXPECT_EQ(fix.line["lat"], 47.5);
  EXPECT_EQ(fix.line["height_m"], 12.5);
  EXPECT_NEAR(fix.line["height_std_m"].get<double>(), 0.3, 1e-12);
  EXPECT_EQ(sink.of_port("depth").at(0).line["pressure_Pa"], 135'000);
  expect_vector(sink.of_port("dvl").at(0).line["bottom_velocity_m_s"], 1, -0.5, 0.25);
  EXPECT_EQ(sink.of_port("sensors").at(0).line["value"], 8.25);
  EXPECT_EQ(sink.left_counts["/camera (sensor_msgs/msg/Image)"], 1);
}

TEST(RosBag, PitchAndRollOfABodyThatIsForwardLeftUp) {
  // Nose up by 0.25 rad is a negative turn about the axis to port; starboard down by 0.5 rad a positive one about
  // the axis forward.
  for (const auto& [q, pitch_rad, roll_rad] :
       {std::tuple(std::array<double, 4>{0, -std::sin(0.125), 0, std::cos(0.125)}, 0.25, 0.0),
        std::tuple(std::array<double, 4>{std::sin(0.25), 0, 0, std::cos(0.25)}, 0.0, 0.5)}) {
    BagWriter bag;
    bag.topic(bag.out, 1, "/imu", "sensor_msgs/msg/Imu");
    Cdr imu;
    imu.header().put(q).put(kVariance).put(std::array<double, 3>{}).put(kVariance);
    BagWriter::message(bag.out, 1, imu.put(std::array<double, 3>{}).put(kVariance).out);
    RecordingSink sink;
    (void)read_ros_bag(bag.finished(), sink);
    const auto attitude = sink.of_port("attitude").at(0);
    EXPECT_NEAR(attitude.line["pitch_rad"].get<double>(), pitch_rad, 1e-12);
    EXPECT_NEAR(attitude.line["roll_rad"].get<double>(), roll_rad, 1e-12);
    EXPECT_NEAR(attitude.line["heading_rad"].get<double>(), std::numbers::pi / 2, 1e-12) << "east";
  }
}

TEST(RosBag, CompressedChunksAreRead) {
  RecordingSink plain;
  (void)read_ros_bag(small_bag(), plain);
  for (const std::string compression : {"lz4", "zstd"}) {
    RecordingSink sink;
    const auto findings = read_ros_bag(small_bag(compression), sink);
    EXPECT_FALSE(findings.cut_at);
    ASSERT_EQ(sink.samples.size(), plain.samples.size()) << compression;
    for (std::size_t i = 0; i < plain.samples.size(); ++i) EXPECT_EQ(sink.samples[i].line, plain.samples[i].line);
    testing::expect_robust(
        small_bag(compression), [](const std::string& file, ImportSink& to) { return read_ros_bag(file, to); }, 3);
  }
  RecordingSink sink;
  (void)read_ros_bag(small_bag("zip"), sink);
  EXPECT_TRUE(sink.samples.empty());
  EXPECT_EQ(sink.left_counts["chunk (compressed with zip, cannot be decompressed)"], 1);
}

/// Two chunks with an Imu each; the first is what the test makes of it. Types and channels stand in it alone.
struct TwoChunks {
  TwoChunks() {
    bag.topic(definitions, 1, "/imu", "sensor_msgs/msg/Imu");
    BagWriter::message(message, 1, imu_message());
    head = bag.out.size();
  }
  /// Number of messages that are read, and the remarks.
  std::pair<std::size_t, std::vector<std::string>> read() {
    bag.chunk(message, "zstd");
    RecordingSink sink;
    const auto findings = read_ros_bag(bag.finished(definitions), sink);
    EXPECT_FALSE(findings.cut_at);
    return {sink.of_port("imu").size(), findings.remarks};
  }
  BagWriter bag;
  std::string definitions, message;
  std::size_t head = 0;
};

TEST(RosBag, SeveralFramesAreOneChunk) {
  for (const std::string compression : {"lz4", "zstd"}) {
    TwoChunks chunks;
    // More than one block of 64 KiB.
    std::string messages;
    for (int i = 0; i < 400; ++i) messages += chunks.message;
    const std::string records = chunks.definitions + messages;
    const std::string frames = compressed(chunks.definitions, compression) + compressed(messages, compression);
    chunks.bag.chunk(records.size(), record::crc32(records), compression, frames);
    EXPECT_EQ(chunks.read(), std::pair(std::size_t{401}, std::vector<std::string>{})) << compression;
  }
}

TEST(RosBag, ADamagedChunkIsNamedAndCostsItselfOnly) {
  for (const std::string compression : {"", "lz4", "zstd"}) {
    const std::string form = compression.empty() ? "not compressed" : "compressed with " + compression;
    const auto expect_named = [&](TwoChunks& chunks, std::uint64_t size, const std::string& reason) {
      const auto [messages, remarks] = chunks.read();
      EXPECT_EQ(messages, 1U) << form;
      ASSERT_EQ(remarks.size(), 1U) << form;
      EXPECT_EQ(remarks[0], "byte " + std::to_string(chunks.head) + ": chunk of " + std::to_string(size) +
                                " bytes left (" + form + ", " + reason + ")");
    };
    TwoChunks wrong_sum;
    const std::string records = wrong_sum.definitions + wrong_sum.message;
    const std::string bytes = compressed(records, compression);
    wrong_sum.bag.chunk(records.size(), record::crc32(records) + 1, compression, bytes);
    expect_named(wrong_sum, records.size(), "its sum is wrong");
    if (compression.empty()) continue;
    TwoChunks cut;
    cut.bag.chunk(records.size(), 0, compression, bytes.substr(0, bytes.size() - 5));
    expect_named(cut, records.size(), "cannot be decompressed");
    // A size that nothing has: an answer, and no memory.
    TwoChunks vast;
    vast.bag.chunk(std::uint64_t{1} << 40, 0, compression, bytes);
    expect_named(vast, std::uint64_t{1} << 40, "cannot be decompressed");
  }
}

TEST(RosBag, ABagOfDamagedChunksSaysWhich) {
  TwoChunks chunks;
  chunks.bag.chunk(100, 0, "zstd", "nonsense");
  try {
    (void)testing::expect_counts_agree("ros2", chunks.bag.finished());
    FAIL();
  } catch (const record::BadRecording& error) {
    EXPECT_NE(std::string(error.what()).find("; byte 40: chunk of 100 bytes left"), std::string::npos)
        << error.what();
  }
}

TEST(RosBag, AChunkThatSwellsBeyondTheLimitIsLeft) {
  TwoChunks chunks;
  std::string frames;
  const std::string frame = compressed(std::string(std::size_t{1} << 24, '\0'), "zstd");
  for (int i = 0; i < 17; ++i) frames += frame;
  chunks.bag.chunk(std::uint64_t{17} << 24, 0, "zstd", frames);
  EXPECT_EQ(chunks.read().first, 1U);
}

TEST(RosBag, BagsOfOthersGiveAllTheirMessages) {
  for (const std::string compression : {"none", "zstd", "lz4"}) {
    std::ifstream file(NAVCAL_SHARED_DIR "/data/wires/bag_" + compression + ".mcap", std::ios::binary);
    if (!file) GTEST_SKIP() << "no bags of others here";
    RecordingSink sink;
    const auto findings = read_ros_bag(std::string{std::istreambuf_iterator<char>(file), {}}, sink);
    EXPECT_FALSE(findings.cut_at);
    EXPECT_EQ(sink.of_port("imu").size(), 400U) << compression;
    EXPECT_EQ(sink.of_port("compass").size(), 80U) << compression;
    EXPECT_TRUE(sink.left_counts.empty()) << compression;
    EXPECT_EQ(sink.of_port("imu").at(7).time_ns - *sink.of_port("imu").at(7).utc_ns, 3'000'000);
    expect_vector(sink.of_port("imu").at(7).line["specific_force_m_s2"], 0, 0, -9.80665);
  }
}

TEST(RosBag, EverySampleIsInTheLogOrCountedAsLeft) {
  const auto written = testing::expect_counts_agree("ros2", small_bag());
  EXPECT_EQ(written.at("imu"), 1U);
  EXPECT_EQ(written.at("attitude"), 1U) << "of the same message";
  BagWriter bag;
  bag.topic(bag.out, 1, "/mag", "sensor_msgs/msg/MagneticField");
  for (const double x : {20e-6, std::nan(""), 1.0})
    BagWriter::message(bag.out, 1, Cdr().header().put(std::array<double, 3>{x, 0, 0}).put(kVariance).out);
  EXPECT_EQ(testing::expect_counts_agree("ros2", bag.finished()).at("compass"), 1U) << "no number, and a tesla";
}

TEST(RosBag, ALogOfNavcalIsNone) {
  std::string log(record::kMcapMagic);
  {
    RecordScope record(log, Opcode::header);
    append_mcap_string(log, record::kProfile);
  }
  EXPECT_FALSE(is_ros_bag(log));
}

TEST(RosBag, NoCutAndNoDamageBringsItDown) {
  testing::expect_robust(
      small_bag(), [](const std::string& file, ImportSink& sink) { return read_ros_bag(file, sink); }, 3);
}

/// Commands of a vehicle in the four forms in which ROS has them.
std::string bag_of_commands() {
  BagWriter bag;
  bag.topic(bag.out, 1, "/rc/out", "mavros_msgs/msg/RCOut");
  bag.topic(bag.out, 2, "/shaft", "std_msgs/msg/Float64");
  bag.topic(bag.out, 3, "/fins", "std_msgs/msg/Float32MultiArray");
  bag.topic(bag.out, 4, "/joints", "sensor_msgs/msg/JointState");
  Cdr outputs;
  outputs.header().put(std::uint32_t{3});
  for (const std::uint16_t pulse_us : std::array<std::uint16_t, 3>{1500, 0, 1900}) outputs.put(pulse_us);
  BagWriter::message(bag.out, 1, outputs.out);
  BagWriter::message(bag.out, 2, Cdr().put(13.0).out);
  Cdr array;
  array.put(std::uint32_t{1}).put(std::uint32_t{5});
  array.out += std::string("fins\0", 5);
  array.put(std::uint32_t{2}).put(std::uint32_t{2}).put(std::uint32_t{0}).put(std::uint32_t{2});
  array.put(0.125F).put(-0.25F);
  BagWriter::message(bag.out, 3, array.out);
  Cdr joints;
  joints.header().put(std::uint32_t{2});
  for (const char* const name : {"rudder", "thruster"}) {
    joints.put(static_cast<std::uint32_t>(std::strlen(name) + 1));
    joints.out += name;
    joints.out += '\0';
  }
  joints.put(std::uint32_t{2}).put(0.375).put(0.0).put(std::uint32_t{2}).put(0.0).put(80.0).put(std::uint32_t{0});
  BagWriter::message(bag.out, 4, joints.out);
  return bag.finished();
}

MotorChannels map_of_commands() {
  return MotorChannels(config::parse_channel_map(
      "[column.\"/rc/out.channels[2]\"]\nmeaning = \"fin_3\"\nfrom = [1100, 1900]\nto = [-0.5, 0.5]\n"
      "[column.\"/shaft.data\"]\nmeaning = \"rpm_commanded\"\nunit = \"rps\"\n"
      "[column.\"/fins.data[1]\"]\nmeaning = \"fin_2\"\n"
      "[column.\"/joints.rudder/position\"]\nmeaning = \"fin_1\"\n"
      "[column.\"/joints.thruster/velocity\"]\nmeaning = \"rpm\"\nscale = 9.5\n",
      "map.toml"));
}

TEST(RosBag, CommandsOfFourTypesMoveShaftAndFins) {
  auto channels = map_of_commands();
  RecordingSink sink;
  (void)read_ros_bag(bag_of_commands(), sink, channels);
  EXPECT_NO_THROW(channels.expect_all_found());
  const auto motor = sink.of_port("motor");
  ASSERT_EQ(motor.size(), 5U);
  EXPECT_NEAR(motor[0].line["fins_rad"][2].get<double>(), 0.5, 1e-12);
  EXPECT_EQ(motor[0].utc_ns, 1'700'000'000'000'000'007) << "the stamp of its header";
  EXPECT_EQ(motor[1].line["quantity"], "output1");
  EXPECT_EQ(motor[1].line["value"], 1500);
  EXPECT_EQ(motor[2].line["rpm_commanded"], 780);
  EXPECT_FALSE(motor[2].utc_ns) << "a message without a header";
  EXPECT_NEAR(motor[3].line["fins_rad"][1].get<double>(), -0.25, 1e-7);
  EXPECT_EQ(motor[4].line["rpm"], 760);
  EXPECT_EQ(motor[4].line["fins_rad"][0], 0.375);
}

TEST(RosBag, CommandsWithoutAMapAreLeftButForPulses) {
  RecordingSink sink;
  (void)read_ros_bag(bag_of_commands(), sink);
  EXPECT_EQ(sink.samples.size(), 2U) << "outputs 1 and 3";
  EXPECT_EQ(sink.left_counts["/shaft (std_msgs/msg/Float64)"], 1);
  EXPECT_EQ(sink.left_counts["/joints (sensor_msgs/msg/JointState)"], 1);
}

TEST(RosBag, DamagedCommandsBringNothingDown) {
  testing::expect_robust(bag_of_commands(), [](const std::string& file, ImportSink& sink) {
    auto channels = map_of_commands();
    return read_ros_bag(file, sink, channels);
  });
}

TEST(RosBag, AChunkInAChunkIsAnError) {
  std::string inner;
  for (int depth = 0; depth < 1000; ++depth) {
    BagWriter outer;
    const std::size_t head = outer.out.size();
    outer.chunk(inner, "");
    inner = outer.out.substr(head);
  }
  BagWriter bag;
  bag.out += inner;
  RecordingSink sink;
  EXPECT_THROW((void)read_ros_bag(bag.finished(), sink), record::BadRecording);
}

TEST(RosBag, LongNamesAreCut) {
  BagWriter bag;
  bag.topic(bag.out, 1, std::string(100'000, 't'), std::string(100'000, 'm'));
  BagWriter::message(bag.out, 1, "");
  RecordingSink sink;
  (void)read_ros_bag(bag.finished(), sink);
  ASSERT_EQ(sink.left_counts.size(), 1U);
  EXPECT_LT(sink.left_counts.begin()->first.size(), 600U);
}

}  // namespace
}  // namespace navcal::analysis
