// SPDX-License-Identifier: Apache-2.0
#include "protocols/mavlink.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>

#include "protocols/crc16.h"
#include "protocols/mavlink_signer.h"
#include "tests/protocols/stream.h"

namespace navcal::protocols::mavlink {
namespace {

using test::Buffer;
using Verdict = Found::Verdict;

Buffer bytes_of(std::string_view hex) {
  Buffer bytes;
  for (std::size_t i = 0; i < hex.size(); i += 2)
    bytes.push_back(static_cast<std::uint8_t>(std::stoi(std::string(hex.substr(i, 2)), nullptr, 16)));
  return bytes;
}

// Made by node-mavlink.
const Buffer kHeartbeat = bytes_of("fd090000000101000000036e339c4c9ef8a9a8a4dc");
const Buffer kSystemTime = bytes_of("fd0c0000060101020000ccfc0638667e030007ee3fc3a37b");
const Buffer kZeros = bytes_of("fd000000040101010000ce59");

constexpr const char *kSignedByNode = "fd090100070101000000050000000c035104035af10300e03cd6921faae52d8c799c",
                     *kSignedLater = "fd090100070101000000050000000c035104035af10301e03cd6921f6c12824870e8";
constexpr Signer::Key kSecret{0x2B, 0xB8, 0x0D, 0x53, 0x7B, 0x1D, 0xA3, 0xE3, 0x8B, 0xD3, 0x03,
                              0x61, 0xAA, 0x85, 0x56, 0x86, 0xBD, 0xE0, 0xEA, 0xCD, 0x71, 0x62,
                              0xFE, 0xF6, 0xA2, 0x5F, 0xE9, 0x7B, 0xF5, 0x27, 0xA2, 0x5B};

std::vector<std::string> names_in(const Buffer& stream) {
  std::vector<std::string> names;
  Parser parser;
  parser.feed(stream, [&](const Frame& frame) { names.emplace_back(frame.id.view()); });
  return names;
}

Buffer joined(std::initializer_list<Buffer> parts) {
  Buffer all;
  for (const Buffer& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

/// A DISTANCE_SENSOR (39 bytes, the last 22 of them zero) with the sum that BlueOS up to 2023 gives it: of all 39.
Buffer untrimmed() {
  Buffer whole = bytes_of("fd2700000501c2840000");
  for (int i = 0; i < 39; ++i) whole.push_back(i < 17 ? static_cast<std::uint8_t>(i + 1) : 0);
  whole.push_back(85);
  const std::uint16_t sum = crc16_mcrf4xx(Bytes(whole).subspan(1));
  whole.resize(10 + 17);
  whole[1] = 17;
  whole.push_back(static_cast<std::uint8_t>(sum));
  whole.push_back(static_cast<std::uint8_t>(sum >> 8));
  return whole;
}

TEST(Mavlink, ReadsTheFieldsOfFramesFromElsewhere) {
  auto found = find_message(kHeartbeat);
  ASSERT_EQ(found.verdict, Verdict::frame);
  EXPECT_EQ(found.message.info->name, "HEARTBEAT");
  EXPECT_EQ(found.message.system, 1);
  EXPECT_EQ(found.message.component, 1);
  EXPECT_EQ(Payload(found.message.payload).at<std::uint32_t>(0), 2620616195U);
  EXPECT_EQ(Payload(found.message.payload).at<std::uint8_t>(4), 76);
  found = find_message(kSystemTime);
  ASSERT_EQ(found.verdict, Verdict::frame);
  EXPECT_EQ(Payload(found.message.payload).at<std::uint64_t>(0), 983402421877964U);
  EXPECT_EQ(Payload(found.message.payload).at<std::uint32_t>(8), 3275746823U);
  found = find_message(kZeros);
  ASSERT_EQ(found.verdict, Verdict::frame) << "all of its payload was cut";
  EXPECT_EQ(Payload(found.message.payload).at<std::uint16_t>(14), 0);
}

TEST(Mavlink, WritesTheFramesOfElsewhere) {
  EXPECT_EQ(encode(0, {1, 1, 0}, Bytes(kHeartbeat).subspan(10, 9)), kHeartbeat);
  EXPECT_EQ(encode(2, {1, 1, 6}, Bytes(kSystemTime).subspan(10, 12)), kSystemTime);
}

// An integer is its four bytes to PX4, and a number like any other to ArduPilot.
TEST(Mavlink, ParametersGoBothWays) {
  for (const bool is_bytewise : {false, true}) {
    for (const Parameter& sent : {Parameter{"COMPASS_OFS_X", Parameter::kFloat, -50.25},
                                  Parameter{"CAL_MAG_COMP_TYP", Parameter::kInt32, -7}}) {
      const Buffer bytes = encode_setting({255, 25, 3}, 9, sent, is_bytewise);
      const auto setting = find_message(bytes);
      ASSERT_EQ(setting.verdict, Verdict::frame);
      EXPECT_EQ(setting.message.id, 23U);
      const Payload payload(setting.message.payload);
      EXPECT_EQ(payload.at<std::uint8_t>(4), 9);
      EXPECT_EQ(payload.at<std::uint8_t>(5), kAutopilot);
      EXPECT_EQ(payload.text(6, 16), sent.name);
      EXPECT_EQ(payload.at<std::uint8_t>(22), sent.type);
      const bool is_as_bytes = is_bytewise && sent.type == Parameter::kInt32;
      EXPECT_EQ(is_as_bytes ? static_cast<double>(payload.at<std::int32_t>(0))
                            : static_cast<double>(payload.at<float>(0)),
                sent.value);
      // What the autopilot answers: value, two counts, name, type.
      Buffer answer(setting.message.payload.begin(), setting.message.payload.begin() + 4);
      answer.resize(8);
      answer.insert(answer.end(), sent.name.begin(), sent.name.end());
      answer.resize(24);
      answer.push_back(sent.type);
      const Buffer frame = encode(22, {9, 1, 0}, answer);
      const Parameter came = parameter_of(find_message(frame).message, is_bytewise);
      EXPECT_EQ(came.name, sent.name);
      EXPECT_EQ(came.type, sent.type);
      EXPECT_EQ(came.value, sent.value);
    }
  }
  const Buffer asked = encode_reading({255, 25, 3}, 9, "COMPASS_OFS_X");
  const Payload payload(find_message(asked).message.payload);
  EXPECT_EQ(payload.at<std::int16_t>(0), -1);
  EXPECT_EQ(payload.at<std::uint8_t>(2), 9);
  EXPECT_EQ(payload.text(4, 16), "COMPASS_OFS_X");
}

/// SIGNED_HEARTBEAT and another one ten microseconds later, made by node-mavlink with SHA-256 of "secret" as the
/// key.
TEST(Mavlink, ChecksSignaturesOfElsewhereAndRefusesReplays) {
  const Buffer first = bytes_of(kSignedByNode), second = bytes_of(kSignedLater);
  Signer signer(kSecret);
  EXPECT_EQ(signer.check(first), Signer::Verdict::good);
  EXPECT_EQ(signer.check(first), Signer::Verdict::replayed);
  EXPECT_EQ(signer.check(second), Signer::Verdict::good);
  EXPECT_EQ(signer.check(first), Signer::Verdict::replayed);
  EXPECT_EQ(signer.check(kHeartbeat), Signer::Verdict::not_signed);
  for (std::size_t i = 0; i < first.size(); ++i) {
    Buffer changed = second;
    changed[i] ^= 0x40U;
    EXPECT_NE(Signer(kSecret).check(changed), Signer::Verdict::good) << i;
  }
  Signer::Key other = kSecret;
  other[31] ^= 1U;
  EXPECT_EQ(Signer(other).check(first), Signer::Verdict::wrong);
}

TEST(Mavlink, SignsWhatItChecksItself) {
  Signer ours(kSecret), theirs(kSecret);
  for (int i = 0; i < 3; ++i) {
    Buffer frame = encode_heartbeat({1, 197, 0}, 18);
    ours.sign(frame);
    ASSERT_EQ(find_message(frame).verdict, Verdict::frame);
    EXPECT_TRUE(find_message(frame).message.is_signed);
    EXPECT_EQ(theirs.check(frame), Signer::Verdict::good) << "each is later than the one before";
  }
  EXPECT_EQ(theirs.check(bytes_of(kSignedByNode)), Signer::Verdict::replayed) << "older by more than a minute";
}

TEST(Mavlink, ASumOfBeforeTheCutIsRecoveredAndSaid) {
  const auto found = find_message(untrimmed());
  ASSERT_EQ(found.verdict, Verdict::frame);
  EXPECT_TRUE(found.message.is_untrimmed);
  EXPECT_EQ(found.message.component, 194);
  EXPECT_FALSE(find_message(kHeartbeat).message.is_untrimmed);
  Buffer damaged = untrimmed();
  damaged[12] ^= 1;
  EXPECT_EQ(find_message(damaged).verdict, Verdict::bad_checksum);
}

TEST(Mavlink, AFalseSumCostsOnlyItsOwnFrame) {
  Buffer damaged = kSystemTime;
  damaged[15] ^= 0x10;
  EXPECT_EQ(names_in(joined({kHeartbeat, damaged, kSystemTime, kZeros})),
            (std::vector<std::string>{"HEARTBEAT", "SYSTEM_TIME", "SYS_STATUS"}));
  // A byte that begins a frame, with a length that would reach over the two that follow.
  EXPECT_EQ(names_in(joined({{0xFE, 40, 1}, kHeartbeat, kSystemTime})),
            (std::vector<std::string>{"HEARTBEAT", "SYSTEM_TIME"}));
}

TEST(Mavlink, SignedFramesAreReadAndUnknownFlagsAreNot) {
  Buffer with_flag = kHeartbeat;
  with_flag[2] = 1;
  Buffer body(with_flag.begin() + 1, with_flag.end() - 2);
  body.push_back(50);
  const std::uint16_t sum = crc16_mcrf4xx(body);
  with_flag[with_flag.size() - 2] = static_cast<std::uint8_t>(sum);
  with_flag.back() = static_cast<std::uint8_t>(sum >> 8);
  const Buffer signature(13, 0xFD);
  const auto found = find_message(joined({with_flag, signature}));
  ASSERT_EQ(found.verdict, Verdict::frame);
  EXPECT_TRUE(found.message.is_signed);
  EXPECT_EQ(found.message.length, kHeartbeat.size() + 13);
  with_flag[2] = 2;
  EXPECT_EQ(find_message(with_flag).verdict, Verdict::not_a_frame);
}

TEST(Mavlink, AMessageThatIsNotKnownHasItsNumber) {
  Buffer unknown = kHeartbeat;
  unknown[8] = 0x77;
  EXPECT_EQ(names_in(joined({unknown, kSystemTime})), (std::vector<std::string>{"MSG 30464", "SYSTEM_TIME"}));
}

TEST(Mavlink, EachMessageIsFoundByItsNumber) {
  int known = 0;
  for (std::uint32_t id = 0; id < 13000; ++id) {
    const MessageInfo* info = message_of(id);
    if (info == nullptr) continue;
    ++known;
    EXPECT_EQ(info->id, id);
    EXPECT_GT(info->length, 0) << info->name;
  }
  EXPECT_EQ(known, 89);
}

/// Messages of a telemetry log by their names, of which each stands behind eight bytes of time.
std::map<std::string, int> counts_of(const std::filesystem::path& file, int& untrimmed) {
  std::ifstream in(file, std::ios::binary);
  const Buffer bytes{std::istreambuf_iterator<char>(in), {}};
  std::map<std::string, int> counts;
  for (std::size_t at = 8; at < bytes.size();) {
    const auto found = find_message(Bytes(bytes).subspan(at));
    if (found.verdict == Verdict::incomplete) break;
    const bool is_frame = found.verdict == Verdict::frame;
    if (is_frame && found.message.is_untrimmed) ++untrimmed;
    if (is_frame && !found.message.is_untrimmed) ++counts[found.message.name()];
    at += is_frame ? found.message.length + 8 : 1;
  }
  return counts;
}

// NAVCAL_WIRES: a folder with logs of real vehicles, and what node-mavlink counts in them.
TEST(Mavlink, CountsOfRealLogsAreThoseOfAnotherDecoder) {
  const char* folder = std::getenv("NAVCAL_WIRES");
  if (folder == nullptr) GTEST_SKIP() << "NAVCAL_WIRES names no folder";
  for (const std::string name : {"small", "vtol"}) {
    std::ifstream in(std::filesystem::path(folder) / "expected" / (name + ".json"));
    std::stringstream text;
    text << in.rdbuf();
    std::string expected = text.str();
    int untrimmed = 0, total = 0;
    for (const auto& [message, count] : counts_of(std::filesystem::path(folder) / (name + ".tlog"), untrimmed)) {
      const std::string pair = '"' + message + "\":" + std::to_string(count);
      EXPECT_NE(expected.find(pair), std::string::npos) << name << ' ' << pair;
      total += count;
    }
    EXPECT_NE(expected.find("\"frames\":" + std::to_string(total)), std::string::npos) << name << ' ' << total;
    EXPECT_EQ(untrimmed, 0) << "the bad ones are of shorter definitions of messages";
  }
}

}  // namespace
}  // namespace navcal::protocols::mavlink
