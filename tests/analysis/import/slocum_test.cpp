// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "analysis/import/log_readers.h"
#include "record/recording.h"
#include "tests/analysis/import/counts_agree.h"
#include "tests/analysis/import/recording_sink.h"

namespace navcal::analysis {
namespace {

using testing::append_number;
using testing::RecordingSink;

/// Writes a dbd file as its description says, in either byte order.
class DbdWriter {
 public:
  explicit DbdWriter(bool is_big_endian, bool is_factored = false) : is_big_endian_(is_big_endian) {
    out =
        "dbd_label:    DBD(dinkum_binary_data)file\nencoding_ver:    5\nnum_ascii_tags:    8\nall_sensors:    0\n"
        "sensor_list_crc:    2e5d9ba9\nsensor_list_factored:    " +
        std::string(is_factored ? "1" : "0") +
        "\nstate_bytes_per_cycle:    2\ntotal_num_sensors:    8\nsensors_per_cycle:    7\n";
    // Tags are counted: nine lines.
    out.replace(out.find("tags:    8") + 9, 1, "9");
    if (is_factored) return;
    out +=
        "s: T 0 0 8 m_present_time timestamp\ns: T 1 1 4 m_depth m\ns: F 2 -1 4 c_unused nodim\n"
        "s: T 3 2 4 m_heading rad\ns: T 4 3 8 m_gps_lat lat\ns: T 5 4 8 m_gps_lon lon\ns: T 6 5 1 x_state enum\n"
        "s: T 7 6 4 sci_water_temp degc\n";
    put_known_cycle();
  }
  void put_known_cycle() {
    out += "sa";
    put(std::int16_t{0x1234});
    put(123.456F);
    put(123456789.12345);
  }
  template <class T>
  void put(T value) {
    const std::size_t first = out.size();
    append_number(out, value);
    if (is_big_endian_) std::reverse(out.begin() + static_cast<std::ptrdiff_t>(first), out.end());
  }
  std::string out;

 private:
  bool is_big_endian_;
};

std::string small_dbd(bool is_big_endian) {
  DbdWriter log(is_big_endian);
  // All but the sixth and seventh are new: 10 10 10 10, 10 00 01 00.
  log.out += std::string("d\xAA\x84", 3);
  log.put(1'700'000'000.5);
  log.put(12.5F);
  log.put(1.5F);
  log.put(4730.0);
  log.put(-12215.0);
  // The first, the sixth and the seventh.
  log.out += std::string("d\x80\x28", 3);
  log.put(1'700'000'004.0);
  log.out.push_back('\x07');
  log.put(8.25F);
  log.out += "X";
  return log.out;
}

TEST(Slocum, ReadsNewValuesInBothByteOrders) {
  for (const bool is_big_endian : {false, true}) {
    ASSERT_TRUE(is_slocum(small_dbd(is_big_endian)));
    RecordingSink sink;
    const auto findings = read_slocum(small_dbd(is_big_endian), {}, sink);
    EXPECT_FALSE(findings.cut_at);
    EXPECT_TRUE(findings.times_are_utc);
    ASSERT_EQ(sink.samples.size(), 4U);
    EXPECT_EQ(sink.of_port("depth").at(0).line["depth_m"], 12.5);
    EXPECT_EQ(sink.of_port("depth").at(0).time_ns, 1'700'000'000'500'000'000);
    EXPECT_EQ(sink.of_port("compass").at(0).line["heading_rad"], 1.5);
    EXPECT_NEAR(sink.of_port("gps").at(0).line["lat"].get<double>(), 47.5, 1e-12) << "degrees and minutes";
    EXPECT_NEAR(sink.of_port("gps").at(0).line["lon"].get<double>(), -122.25, 1e-12);
    EXPECT_EQ(sink.of_port("sensors").at(0).line["quantity"], "water_temp");
    EXPECT_EQ(sink.of_port("sensors").at(0).line["value"], 8.25);
    EXPECT_EQ(sink.left_counts["x_state"], 1);
  }
}

/// Blocks of LZ4 as a glider writes them, whose bytes are all literals.
std::string compressed(const std::string& bytes) {
  std::string out;
  for (std::size_t at = 0; at < bytes.size(); at += 200) {
    const std::string part = bytes.substr(at, 200);
    std::string block = "\xF0";
    if (part.size() < 15) {
      block[0] = static_cast<char>(part.size() << 4);
    } else {
      block += static_cast<char>(part.size() - 15);
    }
    block += part;
    out += '\0';
    out += static_cast<char>(block.size());
    out += block;
  }
  return out;
}

/// Depth and commands of a file whose list is `kList`.
std::string factored_dbd() {
  DbdWriter log(false, true);
  log.put_known_cycle();
  log.out += std::string("d\xAA\xA8", 3);
  log.put(1'700'000'000.5);
  for (const float value : {12.5F, 0.25F, 1.0F, 100.0F, -0.5F, 0.75F}) log.put(value);
  return log.out + "X";
}
constexpr const char* kList =
    "s: T 0 0 8 m_present_time timestamp\ns: T 1 1 4 m_depth m\ns: F 2 -1 4 c_unused nodim\n"
    "s: T 3 2 4 c_fin rad\ns: T 4 3 4 c_battpos in\ns: T 5 4 4 c_de_oil_vol cc\ns: T 6 5 4 m_fin rad\n"
    "s: T 7 6 4 m_battpos in\n";

TEST(Slocum, AListOfSensorsInAnotherFileIsFoundOrNamed) {
  const test::TemporaryFolder beside, cache;
  const std::vector<std::filesystem::path> folders{beside.path(), cache.path()};
  RecordingSink none;
  try {
    (void)read_slocum(factored_dbd(), folders, none);
    FAIL() << "without its list";
  } catch (const record::BadRecording& error) {
    EXPECT_NE(std::string(error.what()).find("2e5d9ba9.cac"), std::string::npos) << error.what();
  }
  for (const char* name : {"2E5D9BA9.CAC", "2e5d9ba9.ccc"}) {
    std::ofstream(cache / name) << (name[9] == 'c' ? compressed(kList) : kList);
    RecordingSink sink;
    EXPECT_FALSE(read_slocum(factored_dbd(), folders, sink).cut_at);
    EXPECT_EQ(sink.of_port("depth").at(0).line["depth_m"], 12.5) << name;
    std::filesystem::remove(cache / name);
  }
}

TEST(Slocum, CommandsAreInTheUnitsOfALayout) {
  const test::TemporaryFolder folder;
  std::ofstream(folder / "2e5d9ba9.cac") << kList;
  RecordingSink sink;
  (void)read_slocum(factored_dbd(), std::vector{std::filesystem::path(folder.path())}, sink);
  std::map<std::string, double> values;
  for (const auto& found : sink.of_port("motor")) {
    if (found.line["class"] == "SENSOR") values[found.line["quantity"]] = found.line["value"];
    if (found.line["class"] == "MOTOR") {
      EXPECT_EQ(found.line["fins_rad"][0], 0.25);
    }
  }
  EXPECT_EQ(sink.of_port("motor").size(), 5U);
  EXPECT_NEAR(values["moving_mass"], 0.0254, 1e-12);
  EXPECT_NEAR(values["ballast"], 1.005, 0.001) << "100 cc of water of 1025 kg/m3";
  EXPECT_EQ(values["m_fin"], -0.5);
  EXPECT_NEAR(values["m_battpos"], 0.75 * 0.0254, 1e-9);
}

TEST(Slocum, OfTwoPumpsTheOneThatIsCommandedIsTheBallast) {
  const test::TemporaryFolder folder;
  std::string list = kList;
  list.replace(list.find("m_fin rad"), 9, "c_ballast_pumped cc");
  std::ofstream(folder / "2e5d9ba9.cac") << list;
  DbdWriter second(false, true);
  second.out = "d\x80\x20";
  second.put(1'700'000'004.0);
  second.put(200.0F);
  std::string file = factored_dbd();
  file.replace(file.size() - 1, 0, second.out);
  RecordingSink sink;
  const auto findings = read_slocum(file, std::vector{std::filesystem::path(folder.path())}, sink);
  std::vector<double> ballast_N;
  for (const auto& found : sink.of_port("motor")) {
    if (found.line["class"] == "SENSOR" && found.line["quantity"] == "ballast")
      ballast_N.push_back(found.line["value"]);
  }
  ASSERT_EQ(ballast_N.size(), 2U) << "not the 100 cc of c_de_oil_vol";
  EXPECT_NEAR(ballast_N[1], 2.010, 0.001);
  ASSERT_EQ(findings.remarks.size(), 1U);
  EXPECT_EQ(findings.remarks[0],
            "the ballast is c_ballast_pumped (2 commands); c_de_oil_vol (1) is that of another pump, and left");
}

TEST(Slocum, ACompressedFileIsReadAsTheSameOne) {
  const std::string file = compressed(small_dbd(false));
  ASSERT_TRUE(is_slocum(file));
  RecordingSink plain, sink;
  (void)read_slocum(small_dbd(false), {}, plain);
  EXPECT_FALSE(read_slocum(file, {}, sink).cut_at);
  ASSERT_EQ(sink.samples.size(), plain.samples.size());
  for (std::size_t i = 0; i < plain.samples.size(); ++i) EXPECT_EQ(sink.samples[i].line, plain.samples[i].line);
}

TEST(Slocum, EverySampleIsInTheLogOrCountedAsLeft) {
  EXPECT_EQ(testing::expect_counts_agree("slocum", compressed(small_dbd(true))),
            (testing::PortCounts{{"compass", 1}, {"depth", 1}, {"gps", 1}, {"sensors", 1}}));
}

TEST(Slocum, NoCutAndNoDamageBringsItDown) {
  const auto read = [](const std::string& file, ImportSink& sink) {
    try {
      return read_slocum(file, {}, sink);
    } catch (const record::BadRecording&) {  // a list in another file
      return ImportFindings{};
    }
  };
  testing::expect_robust(small_dbd(false), read);
  testing::expect_robust(compressed(small_dbd(false)), read);
}

}  // namespace
}  // namespace navcal::analysis
