// SPDX-License-Identifier: Apache-2.0
// navcal-ros2 between a running navcald and Fast DDS, on the loopback address without multicast.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>
#include <utility>

#include "record/byte_source.h"
#include "record/json/flat_json.h"
#include "record/json/mapping_json.h"
#include "record/log/log_messages.h"
#include "record/log/log_reader.h"
#include "tests/daemon/daemon_process.h"
#include "tests/ros2/fast_cdr.h"
#include "tests/ros2/fast_peer.h"
#include "tests/support/process.h"

namespace navcal::ros2 {
namespace {

using navcal::test::eventually;
using navcal::test::Process;
using navcal::test::TemporaryFolder;
using nlohmann::json;
using test::FastCdr;
using test::FastPeer;
using test::Received;
using test::utc_now_ns;
using Reliability = test::FastPeer::Reliability;

constexpr std::chrono::seconds kPatience{60};
/// Ends only a broken test.
bool soon(const std::function<bool()>& condition) { return eventually(condition, kPatience); }

struct Topic {
  std::string topic, type;
};
/// Topics of navcal-ros2 as DDS has them, of the port "other".
const std::map<std::string, Topic> kTopics{
    {"imu", {"rt/navcal/other/data", "sensor_msgs::msg::dds_::Imu_"}},
    {"attitude", {"rt/navcal/other/attitude", "sensor_msgs::msg::dds_::Imu_"}},
    {"mag", {"rt/navcal/other/mag", "sensor_msgs::msg::dds_::MagneticField_"}},
    {"pressure", {"rt/navcal/other/pressure", "sensor_msgs::msg::dds_::FluidPressure_"}},
    {"fix", {"rt/navcal/other/fix", "sensor_msgs::msg::dds_::NavSatFix_"}},
    {"twist", {"rt/navcal/other/twist", "geometry_msgs::msg::dds_::TwistWithCovarianceStamped_"}},
    {"odometry", {"rt/navcal/odometry", "nav_msgs::msg::dds_::Odometry_"}},
    {"diagnostics", {"rt/diagnostics", "diagnostic_msgs::msg::dds_::DiagnosticArray_"}}};
/// Kinds that --in takes here, which are topics of navcal-ros2 again.
const std::vector<std::string> kSources{"imu", "mag", "pressure", "fix", "twist"};

std::string decimal_seconds(std::int64_t ns) {
  std::string digits = std::to_string(ns);
  return digits.insert(digits.size() - 9, ".");
}

/// Memory in kB and processor time of a process, in words.
std::string use_of(pid_t pid) {
  const std::string folder = "/proc/" + std::to_string(pid);
  std::string words;
  std::ifstream memory(folder + "/smaps_rollup"), stat(folder + "/stat");
  for (std::string line; std::getline(memory, line);) {
    if (line.starts_with("Rss:") || line.starts_with("Pss:") || line.starts_with("Private_")) words += line + "; ";
  }
  std::string field;
  double ticks = 0;
  for (int i = 1; stat >> field; ++i) {
    constexpr int kUser = 14, kSystem = 15;
    if (i == kUser || i == kSystem) ticks += std::stod(field);
  }
  return words + std::to_string(ticks / static_cast<double>(::sysconf(_SC_CLK_TCK))) + " s of processor";
}

/// A message of the log, with its time of validity.
struct Logged {
  std::int64_t time_ns = 0;
  json message;
};

/// navcald with a port for samples, navcal-ros2 in a domain of its own, and a node of Fast DDS.
struct Ros2 : ::testing::Test {
  TemporaryFolder folder;
  std::uint32_t domain = 1 + static_cast<std::uint32_t>(::getpid()) % 99;
  std::unique_ptr<daemon::DaemonProcess> navcald;
  std::unique_ptr<Process> program;
  std::unique_ptr<FastPeer> peer;
  std::map<std::string, const FastPeer::Reader*> readers;

  [[nodiscard]] std::string samples() const { return (folder / "samples").string(); }

  void SetUp() override {
    ::setenv("CYCLONEDDS_URI", "file://" NAVCAL_SOURCE_DIR "/systemd/ros2-loopback.xml", 1);
    navcald = std::make_unique<daemon::DaemonProcess>(
        std::vector<std::string>{"--set", "navigation.interval_s=0.1", "--set", "status.health_interval_s=1"}, "",
        "[port.other]\nprotocol = \"samples\"\naddress = \"unix-listen:" + samples() + "\"\n");
    navcald->wait_until_ready();
    ASSERT_TRUE(soon([&] { return std::filesystem::exists(samples()); }));
    peer = std::make_unique<FastPeer>(domain);
  }
  void start(const std::vector<std::string>& more = {}) {
    std::vector<std::string> command{NAVCAL_ROS2,
                                     "--domain",
                                     std::to_string(domain),
                                     "--status",
                                     "127.0.0.1:" + std::to_string(navcald->port()),
                                     "--samples",
                                     samples()};
    command.insert(command.end(), more.begin(), more.end());
    program = std::make_unique<Process>(command, folder / "navcal-ros2");
    ASSERT_TRUE(soon([&] { return program->err().find("connected to navcald") != std::string::npos; }))
        << program->err();
  }
  void read_all() {
    bool is_reliable = false;
    for (const auto& [name, topic] : kTopics) {
      readers[name] = &peer->read(topic.topic, topic.type,
                                  (is_reliable = !is_reliable) ? Reliability::reliable : Reliability::best_effort);
    }
  }
  [[nodiscard]] std::size_t count(const std::string& name) const { return readers.at(name)->received().size(); }

  /// One sample of each kind, valid now. Values differ from round to round.
  void inject(daemon::Client& port, int round) const {
    const double x = 0.001 * round;
    const std::int64_t now_ns = utc_now_ns();
    const std::string time = ",\"time\":" + decimal_seconds(now_ns) + ",\"time_std\":0.001";
    const auto line = [&](const std::string& text) { return text + time + "}\n"; };
    const auto three = [&](double a, double b, double c) { return json::array({a + x, b, c - x}).dump(); };
    port.send(
        line(R"({"class":"IMU","rate_std_rad_s":0.002,"specific_force_std_m_s2":0.03,"rate_rad_s":)" +
             three(0.01, -0.02, 0.03) + ",\"specific_force_m_s2\":" + three(0.1, 0.2, -9.7)) +
        line(
            R"({"class":"COMPASS","heading_is_true":true,"heading_std_rad":0.01,"pitch_rad":0.05,"roll_rad":-0.1,)"
            R"("tilt_std_rad":0.004,"field_std_uT":0.3,"heading_rad":)" +
            json(0.7 + x).dump() + ",\"field_body_uT\":" + three(17.25, -3.5, 44.125)) +
        line(R"({"class":"GPS","lon":18.0625,"height_m":31.5,"position_std_m":1.75,"height_std_m":3.25,"lat":)" +
             json(59.3 + x * 1e-5).dump()) +
        line(R"({"class":"DEPTH","pressure_std_Pa":40.0,"pressure_Pa":)" + json(131325.0 + round).dump()) +
        line(R"({"class":"DVL","frame":"body","bottom_velocity_std_m_s":0.02,"bottom_velocity_m_s":)" +
             three(1.1, 0.05, -0.02)));
  }
  [[nodiscard]] bool come(const std::map<std::string, std::size_t>& numbers) const {
    return std::all_of(numbers.begin(), numbers.end(),
                       [&](const auto& one) { return count(one.first) >= one.second; });
  }
  /// Sends rounds until each of kSources has come: a topic is there from its first message on, and readers know it
  /// a little later. Then waits until nothing more comes; the numbers that have.
  std::map<std::string, std::size_t> settle(const std::function<void()>& send) const {
    std::map<std::string, std::size_t> one, before, now;
    for (const std::string& name : kSources) one[name] = 1;
    EXPECT_TRUE(soon([&] {
      send();
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      return come(one);
    })) << program->err();
    EXPECT_TRUE(soon([&] {
      before = std::exchange(now, {});
      for (const std::string& name : kSources) now[name] = count(name);
      std::this_thread::sleep_for(std::chrono::milliseconds(300));
      return before == now;
    }));
    return now;
  }
  /// Sends rounds, each as soon as the one before has come through. So no test depends on a speed, and a message
  /// that does not come ends it.
  void send_rounds(int rounds, std::map<std::string, std::size_t> numbers, const std::function<void(int)>& send) {
    for (int round = 1; round <= rounds; ++round) {
      send(round);
      for (auto& [name, number] : numbers) ++number;
      ASSERT_TRUE(soon([&] { return come(numbers); })) << "round " << round << ": " << program->err();
    }
  }
  /// The messages of the log by topic, as navcald has written them so far.
  [[nodiscard]] std::map<std::string, std::vector<Logged>> log() const {
    std::map<std::string, std::vector<Logged>> found;
    for (const auto& file : navcald->logs()) {
      record::LogReader reader(record::open_file(file), file.string());
      while (const auto message = reader.next()) {
        const auto& channel = reader.channels().at(message->channel);
        if (channel.raw) continue;
        const auto flat = record::FlatJson::parse(message->data);
        const auto time_ns = flat ? record::nanoseconds(flat->get("time")) : std::nullopt;
        found[channel.topic].push_back(
            {time_ns.value_or(static_cast<std::int64_t>(message->publish_time_ns)), json::parse(message->data)});
      }
    }
    return found;
  }
};

/// Calls `compare(FastCdr&, message of the log)` for each message that came, behind its header. Whatever the log
/// has between the first and the last of them must have come, with the same stamps.
template <class Compare>
void expect_those_of_the_log(const std::vector<Received>& received, const std::vector<Logged>& logged,
                             Compare compare) {
  ASSERT_FALSE(received.empty());
  std::size_t at = 0;
  const std::int64_t first_ns = FastCdr(received.front().cdr).header();
  while (at < logged.size() && logged[at].time_ns != first_ns) ++at;
  for (const Received& one : received) {
    ASSERT_LT(at, logged.size());
    FastCdr cdr(one.cdr);
    ASSERT_EQ(cdr.header(), logged[at].time_ns);
    compare(cdr, logged[at].message);
    ++at;
  }
}

/// Forward, left, up of a vector that is forward, starboard, down.
std::array<double, 3> turned(const json& frd) {
  return {frd[0].get<double>(), -frd[1].get<double>(), -frd[2].get<double>()};
}
template <std::size_t N>
std::array<double, N> diagonal(const std::vector<double>& variances) {
  std::array<double, N> matrix{};
  for (std::size_t i = 0; i < variances.size(); ++i) matrix[i * (variances.size() + 1)] = variances[i];
  return matrix;
}
template <std::size_t N>
void expect_near(const std::array<double, N>& found, const std::array<double, N>& expected) {
  for (std::size_t i = 0; i < N; ++i) EXPECT_NEAR(found[i], expected[i], 1e-12 * (1 + std::abs(expected[i]))) << i;
}
double squared(const json& value) { return value.get<double>() * value.get<double>(); }

/// Rotation of a body (forward, left, up) in the world (east, north, up), row by row, from its quaternion and from
/// heading, pitch and roll.
std::array<double, 9> matrix_of(const std::array<double, 4>& q) {
  const auto [x, y, z, w] = q;
  return {1 - 2 * (y * y + z * z), 2 * (x * y - w * z),     2 * (x * z + w * y),
          2 * (x * y + w * z),     1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
          2 * (x * z - w * y),     2 * (y * z + w * x),     1 - 2 * (x * x + y * y)};
}
std::array<double, 9> matrix_of(double heading, double pitch, double roll) {
  const double ch = std::cos(heading), sh = std::sin(heading), cp = std::cos(pitch), sp = std::sin(pitch);
  const double cr = std::cos(roll), sr = std::sin(roll);
  // Columns in north, east, down of what is forward, starboard, down; then rows and columns in the other order.
  const double forward[3] = {cp * ch, cp * sh, -sp};
  const double starboard[3] = {sr * sp * ch - cr * sh, sr * sp * sh + cr * ch, sr * cp};
  const double down[3] = {cr * sp * ch + sr * sh, cr * sp * sh - sr * ch, cr * cp};
  return {forward[1], -starboard[1], -down[1],     forward[0], -starboard[0],
          -down[0],   -forward[2],   starboard[2], down[2]};
}

TEST_F(Ros2, EveryRecordComesWithEachOfItsFields) {
  start();
  read_all();
  daemon::Client port{std::filesystem::path(samples())};
  const auto settled = settle([&] { inject(port, 0); });
  send_rounds(100, settled, [&](int round) { inject(port, round); });
  ASSERT_TRUE(soon([&] {
    inject(port, 0);
    return count("odometry") > 20 && count("diagnostics") > 2;
  }));
  const std::string used = use_of(program->pid());
  EXPECT_EQ(navcald->stop(SIGTERM), 0);
  program->signal(SIGTERM);
  EXPECT_EQ(program->wait(kPatience), 0) << program->err();
  EXPECT_NE(program->out().find("on 8 topics, 0 lost, 0 without UTC"), std::string::npos) << program->out();
  auto logged = log();
  const auto received = [&](const std::string& name) { return readers.at(name)->received(); };

  expect_those_of_the_log(received("imu"), logged["/imu"], [](FastCdr& cdr, const json& imu) {
    EXPECT_EQ(cdr.frame, "base_link");
    cdr.doubles<4>();
    EXPECT_EQ(cdr.doubles<9>()[0], -1) << "an inertial unit has no orientation";
    EXPECT_EQ(cdr.doubles<3>(), turned(imu["rate_rad_s"]));
    const double rate = squared(imu["rate_std_rad_s"]), force = squared(imu["specific_force_std_m_s2"]);
    expect_near(cdr.doubles<9>(), diagonal<9>({rate, rate, rate}));
    EXPECT_EQ(cdr.doubles<3>(), turned(imu["specific_force_m_s2"]));
    expect_near(cdr.doubles<9>(), diagonal<9>({force, force, force}));
  });
  expect_those_of_the_log(received("attitude"), logged["/compass"], [](FastCdr& cdr, const json& compass) {
    expect_near(matrix_of(cdr.doubles<4>()),
                matrix_of(compass["heading_rad"], compass["pitch_rad"], compass["roll_rad"]));
    const double tilt = squared(compass["tilt_std_rad"]);
    expect_near(cdr.doubles<9>(), diagonal<9>({tilt, tilt, squared(compass["heading_std_rad"])}));
  });
  expect_those_of_the_log(received("mag"), logged["/compass"], [](FastCdr& cdr, const json& compass) {
    auto field = turned(compass["field_body_uT"]);
    for (double& component : field) component *= 1e-6;
    expect_near(cdr.doubles<3>(), field);
    const double variance = squared(compass["field_std_uT"]) * 1e-12;
    expect_near(cdr.doubles<9>(), diagonal<9>({variance, variance, variance}));
  });
  expect_those_of_the_log(received("pressure"), logged["/depth"], [](FastCdr& cdr, const json& depth) {
    EXPECT_EQ(cdr.take<double>(), depth["pressure_Pa"]);
    EXPECT_NEAR(cdr.take<double>(), squared(depth["pressure_std_Pa"]), 1e-9);
  });
  expect_those_of_the_log(received("fix"), logged["/gps"], [](FastCdr& cdr, const json& gps) {
    EXPECT_EQ(cdr.take<std::int8_t>(), 0);
    EXPECT_EQ(cdr.take<std::uint16_t>(), 1);
    EXPECT_EQ(cdr.take<double>(), gps["lat"]);
    EXPECT_EQ(cdr.take<double>(), gps["lon"]);
    EXPECT_EQ(cdr.take<double>(), gps["height_m"]);
    const double position = squared(gps["position_std_m"]);
    expect_near(cdr.doubles<9>(), diagonal<9>({position, position, squared(gps["height_std_m"])}));
    EXPECT_EQ(cdr.take<std::uint8_t>(), 2) << "the diagonal is known";
  });
  expect_those_of_the_log(received("twist"), logged["/dvl"], [](FastCdr& cdr, const json& dvl) {
    EXPECT_EQ(cdr.doubles<3>(), turned(dvl["bottom_velocity_m_s"]));
    EXPECT_EQ(cdr.doubles<3>(), (std::array<double, 3>{}));
    const double velocity = squared(dvl["bottom_velocity_std_m_s"]);
    expect_near(cdr.doubles<36>(), diagonal<36>({velocity, velocity, velocity, 1e6, 1e6, 1e6}));
  });
  expect_those_of_the_log(received("odometry"), logged["/nav"], [](FastCdr& cdr, const json& nav) {
    EXPECT_EQ(cdr.frame, "odom");
    EXPECT_EQ(cdr.take<std::string>(), "base_link");
    const auto position = cdr.doubles<3>();
    EXPECT_EQ(position[2], -nav["depth_m"].get<double>());
    expect_near(matrix_of(cdr.doubles<4>()), matrix_of(nav["heading_rad"], nav["pitch_rad"], nav["roll_rad"]));
  });
  // Reports have no time with nine decimals, and the log's own scale is fixed when it begins: a second tells them
  // apart.
  for (const Received& one : received("diagnostics")) {
    constexpr std::int64_t kNear_ns = 100'000'000;
    FastCdr cdr(one.cdr);
    const std::int64_t stamp_ns = cdr.header();
    const auto& reports = logged["/health"];
    const auto report = std::find_if(reports.begin(), reports.end(), [&](const Logged& logged_report) {
      return std::abs(logged_report.time_ns - stamp_ns) < kNear_ns;
    });
    ASSERT_NE(report, reports.end());
    EXPECT_EQ(cdr.take<std::uint32_t>(), report->message["alarms"].size() + report->message["ports"].size() + 1)
        << "and the log";
  }
  // From the stamp of a round, which is when its lines were written, through navcald and both programs.
  std::vector<double> latencies_ms;
  for (const Received& one : received("imu"))
    latencies_ms.push_back(static_cast<double>(one.at_utc_ns - FastCdr(one.cdr).header()) * 1e-6);
  std::nth_element(latencies_ms.begin(), latencies_ms.begin() + latencies_ms.size() / 2, latencies_ms.end());
  std::size_t messages = 0;
  for (const auto& [name, reader] : readers) messages += reader->received().size();
  std::printf("navcal-ros2, %zu messages: %s; stamp to reader through navcald: median %.2f ms of %zu\n", messages,
              used.c_str(), latencies_ms[latencies_ms.size() / 2], latencies_ms.size());
}

/// One message of each kind that navcal-ros2 takes, as a driver writes it.
std::map<std::string, std::string> driver_messages(std::int64_t stamp_ns, int round) {
  const double x = 0.001 * round;
  const auto nine = [](double variance) { return diagonal<9>({variance, variance, variance}); };
  std::map<std::string, std::string> made;
  const auto make = [&](const std::string& kind, const std::function<void(FastCdr&)>& put) {
    FastCdr cdr;
    cdr.put_header(stamp_ns, "sensor");
    put(cdr);
    made[kind] = cdr.bytes();
  };
  make("imu", [&](FastCdr& cdr) {
    cdr.put(std::array<double, 4>{}).put(std::array<double, 9>{-1});
    cdr.put(std::array<double, 3>{0.1 + x, 0.2, 0.3}).put(nine(0.0004));
    cdr.put(std::array<double, 3>{0.5, -0.25, 9.75}).put(nine(0.01));
  });
  make("mag", [&](FastCdr& cdr) { cdr.put(std::array<double, 3>{17e-6, 3e-6, -44e-6}).put(nine(0.25e-12)); });
  make("pressure", [&](FastCdr& cdr) { cdr.put(101325.0 + round).put(1600.0); });
  make("fix", [&](FastCdr& cdr) {
    cdr.put(std::int8_t{0}).put(std::uint16_t{1}).put(std::array<double, 3>{59.3, 18.0, 31.5});
    cdr.put(nine(4.0)).put(std::uint8_t{2});
  });
  make("twist", [&](FastCdr& cdr) {
    cdr.put(std::array<double, 3>{1.0 + x, 0.5, 0.25}).put(std::array<double, 3>{});
    cdr.put(diagonal<36>({0.0001, 0.0001, 0.0001, 1e6, 1e6, 1e6}));
  });
  return made;
}

/// Writers of all kinds that navcal-ros2 takes, on topics "/in/KIND".
struct Drivers {
  explicit Drivers(FastPeer& peer) {
    for (const std::string& kind : kSources) writers[kind] = &peer.write("rt/in/" + kind, kTopics.at(kind).type);
  }
  [[nodiscard]] bool matched() const {
    return std::all_of(writers.begin(), writers.end(),
                       [](const auto& one) { return test::is_matched(*one.second); });
  }
  void write(const std::map<std::string, std::string>& messages) {
    for (auto [kind, cdr] : messages) writers.at(kind)->write(&cdr);
  }
  static std::vector<std::string> options() {
    std::vector<std::string> all;
    for (const std::string& kind : kSources) all.insert(all.end(), {"--in", kind + "=/in/" + kind});
    return all;
  }
  std::map<std::string, test::dds::DataWriter*> writers;
};

TEST_F(Ros2, MessagesOfOthersBecomeSamplesWithTheirStamps) {
  start(Drivers::options());
  read_all();
  Drivers drivers(*peer);
  ASSERT_TRUE(soon([&] { return drivers.matched(); }));
  ASSERT_TRUE(soon([&] { return program->err().find(samples() + ": connected") != std::string::npos; }));
  constexpr int kRounds = 50;
  std::vector<std::int64_t> stamps_ns;
  const auto settled = settle([&] { drivers.write(driver_messages(utc_now_ns(), 0)); });
  send_rounds(kRounds, settled, [&](int round) {
    stamps_ns.push_back(utc_now_ns() - 5'000'000);
    drivers.write(driver_messages(stamps_ns.back(), round));
  });
  EXPECT_EQ(navcald->stop(SIGTERM), 0);
  auto logged = log();
  for (const char* topic : {"/imu", "/compass", "/depth", "/gps", "/dvl"}) {
    auto& messages = logged[topic];
    ASSERT_GE(messages.size(), static_cast<std::size_t>(kRounds)) << topic;
    messages.erase(messages.begin(), messages.end() - kRounds);
    for (std::size_t i = 0; i < stamps_ns.size(); ++i) EXPECT_EQ(messages[i].time_ns, stamps_ns[i]) << topic << i;
  }
  for (int i = 0; i < kRounds; ++i) {
    const auto message = [&](const char* topic) { return logged[topic][static_cast<std::size_t>(i)].message; };
    const double x = 0.001 * (i + 1);
    EXPECT_EQ(message("/imu")["rate_rad_s"], (json{0.1 + x, -0.2, -0.3}));
    EXPECT_NEAR(message("/imu")["rate_std_rad_s"], 0.02, 1e-12);
    EXPECT_EQ(message("/imu")["specific_force_m_s2"], (json{0.5, 0.25, -9.75}));
    EXPECT_NEAR(message("/imu")["specific_force_std_m_s2"], 0.1, 1e-12);
    EXPECT_NEAR(message("/compass")["field_body_uT"][2], 44, 1e-9);
    EXPECT_NEAR(message("/compass")["field_std_uT"], 0.5, 1e-9);
    EXPECT_EQ(message("/depth")["pressure_Pa"], 101326.0 + i);
    EXPECT_EQ(message("/depth")["pressure_std_Pa"], 40);
    EXPECT_NEAR(message("/gps")["lat"], 59.3, 1e-12);
    EXPECT_EQ(message("/gps")["position_std_m"], 2);
    EXPECT_EQ(message("/dvl")["bottom_velocity_m_s"], (json{1.0 + x, -0.5, -0.25}));
    EXPECT_NEAR(message("/dvl")["bottom_velocity_std_m_s"], 0.01, 1e-12);
  }
}

TEST_F(Ros2, AStoppedReaderHoldsNothingUp) {
  start();
  read_all();
  Process listener({LISTENER, std::to_string(domain), "rt/navcal/other/data"}, folder / "listener");
  const auto heard = [&] { return !listener.out().empty(); };
  daemon::Client port{std::filesystem::path(samples())};
  ASSERT_TRUE(soon([&] {
    inject(port, 0);
    return heard();
  })) << listener.err();
  listener.signal(SIGSTOP);
  send_rounds(100, settle([&] { inject(port, 0); }), [&](int round) { inject(port, round); });
  const std::string before = listener.out();
  listener.signal(SIGCONT);
  ASSERT_TRUE(soon([&] {
    inject(port, 0);
    return listener.out() != before;
  })) << "it goes on with what is new";
}

TEST_F(Ros2, WrongTypesAndLengthsAreNamedAndDoNoHarm) {
  start({"--in", "imu=/in/imu"});
  read_all();
  auto& writer = peer->write("rt/in/imu", kTopics.at("imu").type);
  FastPeer other(domain);
  auto& wrong_writer = other.write("rt/in/imu", "std_msgs::msg::dds_::String_");
  const auto& wrong_reader =
      other.read("rt/navcal/other/data", "std_msgs::msg::dds_::String_", Reliability::best_effort);
  ASSERT_TRUE(soon([&] { return test::is_matched(writer); }));
  const std::string good = driver_messages(utc_now_ns(), 1)["imu"];
  // A frame that states four thousand million bytes, one of 200 kB, a message that is cut, and no encoding known.
  std::string long_frame = good, cut = good.substr(0, 100), no_encoding = good;
  for (std::size_t i = 12; i < 16; ++i) long_frame[i] = '\xff';
  no_encoding[1] = 7;
  FastCdr large;
  large.put_header(utc_now_ns(), std::string(200'000, 'x')).put(std::array<double, 37>{});
  std::vector<std::string> bad{long_frame, cut, no_encoding, large.bytes(), std::string(4, '\0')};
  ASSERT_TRUE(soon([&] {
    for (std::string message : bad) {
      writer.write(&message);
      wrong_writer.write(&message);
    }
    return program->err().find("/in/imu: not a whole sensor_msgs/msg/Imu, 8 so far") != std::string::npos;
  })) << program->err();
  EXPECT_FALSE(test::is_matched(wrong_writer));
  EXPECT_FALSE(wrong_reader.matched());
  ASSERT_TRUE(soon([&] {
    std::string message = driver_messages(utc_now_ns(), 1)["imu"];
    writer.write(&message);
    return count("imu") > 0;
  })) << program->err();
}

TEST_F(Ros2, NavcaldMayComeAgain) {
  start({"--in", "imu=/in/imu"});
  read_all();
  auto& writer = peer->write("rt/in/imu", kTopics.at("imu").type);
  const auto comes_through = [&] {
    const std::size_t before = count("imu");
    return soon([&] {
      std::string message = driver_messages(utc_now_ns(), 1)["imu"];
      writer.write(&message);
      return count("imu") > before;
    });
  };
  EXPECT_TRUE(comes_through()) << program->err();
  navcald->stop(SIGKILL);
  EXPECT_TRUE(soon([&] { return program->err().find("closed the connection") != std::string::npos; }))
      << program->err();
  navcald->start_again();
  EXPECT_TRUE(comes_through()) << program->err();
}

TEST_F(Ros2, APoseIsSentWhereItIsAskedForAndAxesMayBeThoseOfNavcal) {
  start({"--tf", "--ned", "--namespace", "/boat"});
  const auto& tf = peer->read("rt/tf", "tf2_msgs::msg::dds_::TFMessage_", Reliability::reliable);
  const auto& imu = peer->read("rt/boat/other/data", kTopics.at("imu").type, Reliability::reliable);
  daemon::Client port{std::filesystem::path(samples())};
  ASSERT_TRUE(soon([&] {
    inject(port, 0);
    return !tf.received().empty() && !imu.received().empty();
  })) << program->err();
  FastCdr message(imu.received().back().cdr);
  message.header();
  message.doubles<13>();
  EXPECT_EQ(message.doubles<3>(), (std::array{0.01, -0.02, 0.03}));
  FastCdr transforms(tf.received().back().cdr);
  EXPECT_EQ(transforms.take<std::uint32_t>(), 1U);
  transforms.header();
  EXPECT_EQ(transforms.frame, "odom_ned");
  EXPECT_EQ(transforms.take<std::string>(), "base_link_frd");
}

TEST(Ros2CommandLine, AMistakeIsSaid) {
  TemporaryFolder folder;
  const auto said = [&](const std::vector<std::string>& options) {
    std::vector<std::string> command{NAVCAL_ROS2};
    command.insert(command.end(), options.begin(), options.end());
    Process process(command, folder / "program");
    EXPECT_EQ(process.wait(kPatience), options[0] == "--help" ? 0 : 2);
    return process.out() + process.err();
  };
  EXPECT_NE(said({"--help"}).find("Example: navcal-ros2"), std::string::npos);
  EXPECT_NE(said({"--in", "sonar=/x"}).find("KIND=/TOPIC with a kind of imu, mag"), std::string::npos);
  EXPECT_NE(said({"--in", "imu=x"}).find("KIND=/TOPIC"), std::string::npos);
  EXPECT_NE(said({"--status", "localhost"}).find("wants HOST:PORT"), std::string::npos);
  EXPECT_NE(said({"--namespace", "/a//b"}).find("wants /NAME"), std::string::npos);
  EXPECT_NE(said({"--domain", "233"}).find("--domain"), std::string::npos);
}

}  // namespace
}  // namespace navcal::ros2
