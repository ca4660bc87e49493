// SPDX-License-Identifier: Apache-2.0
#include "analysis/import/slocum.h"

#include <gtest/gtest.h>

#include <algorithm>

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
    const auto findings = read_slocum(small_dbd(is_big_endian), sink);
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

TEST(Slocum, AListOfSensorsInAnotherFileIsNamed) {
  RecordingSink sink;
  const auto findings = read_slocum(DbdWriter(false, true).out, sink);
  ASSERT_EQ(findings.remarks.size(), 1U);
  EXPECT_NE(findings.remarks[0].find("2e5d9ba9.cac"), std::string::npos);
}

TEST(Slocum, NoCutAndNoDamageBringsItDown) {
  testing::expect_robust(small_dbd(false),
                         [](const std::string& file, ImportSink& sink) { return read_slocum(file, sink); });
}

}  // namespace
}  // namespace navcal::analysis
