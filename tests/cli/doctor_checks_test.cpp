// SPDX-License-Identifier: Apache-2.0
// Each check against what it is about: pseudo-terminals, sockets, folders; and tables of the kernel that were made
// up for what cannot be arranged here.
#include "cli/live/doctor_checks.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <filesystem>
#include <fstream>

#include "ports/pseudo_terminal.h"
#include "tests/support/process.h"
#include "tests/support/temporary_folder.h"

namespace navcal::cli {
namespace {

namespace fs = std::filesystem;
using Severity = Finding::Severity;

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(DoctorAccount, TheFirstOfOwnerGroupAndOthersThatAppliesDecides) {
  const Account account{"somebody", 1000, {20, 100}};
  EXPECT_TRUE(may_read_and_write(account, 1000, 5, 0600));
  EXPECT_FALSE(may_read_and_write(account, 1000, 20, 0066)) << "an owner without rights has none by its group";
  EXPECT_TRUE(may_read_and_write(account, 0, 20, 0660));
  EXPECT_FALSE(may_read_and_write(account, 0, 20, 0640));
  EXPECT_FALSE(may_read_and_write(account, 0, 20, 0606)) << "nor a member by the others";
  EXPECT_FALSE(may_read_and_write(account, 0, 5, 0660));
  EXPECT_TRUE(may_read_and_write(account, 0, 5, 0666));
  EXPECT_TRUE(may_read_and_write({"root", 0, {}}, 1000, 5, 0000));
}

TEST(DoctorAccount, OursMayUseOurFilesAndNobodyOneThatIsNotThere) {
  const navcal::test::TemporaryFolder folder;
  EXPECT_TRUE(may_read_and_write(own_account(), folder.path()));
  EXPECT_FALSE(may_read_and_write(own_account(), folder / "absent"));
  EXPECT_EQ(group_of(folder / "absent"), "");
  EXPECT_NE(group_of(folder.path()), "");
}

config::PortSettings port_at(const std::string& path) {
  config::PortSettings port;
  port.name = "compass";
  port.path = path;
  return port;
}

TEST(DoctorPort, OneThatIsNotThereIsAFault) {
  const Finding finding = check_port(port_at("/dev/navcal-is-not-there"), own_account());
  EXPECT_EQ(finding.severity, Severity::fault);
  EXPECT_EQ(finding.topic, "port compass");
  EXPECT_TRUE(holds(finding.found, "/dev/navcal-is-not-there: no such device")) << finding.found;
  EXPECT_FALSE(finding.mend.empty());
}

TEST(DoctorPort, OneThatNobodyHoldsIsGoodAndOneThatAProgramReadsIsNamedWithIt) {
  const navcal::test::TemporaryFolder folder;
  const auto terminal = ports::make_pseudo_terminal(9600);
  EXPECT_EQ(check_port(port_at(terminal.slave_name), own_account()).severity, Severity::good);

  navcal::test::Process reader({"sh", "-c", "exec 3<" + terminal.slave_name + "; echo open; exec cat <&3"},
                               folder / "reader");
  while (!holds(reader.out(), "open") && !reader.wait(std::chrono::seconds(0))) {
  }
  const Finding finding = check_port(port_at(terminal.slave_name), own_account());
  EXPECT_EQ(finding.severity, Severity::fault) << finding.found;
  EXPECT_TRUE(holds(finding.found, terminal.slave_name + " is held by ")) << finding.found;
  EXPECT_TRUE(holds(finding.found, "(process " + std::to_string(reader.pid()) + ")")) << finding.found;
  EXPECT_FALSE(finding.mend.empty());
}

TEST(DoctorPort, OneThatIsNotOursToUseSaysWhichGroupIsMissing) {
  const auto terminal = ports::make_pseudo_terminal(9600);
  const Account stranger{"stranger", 54321, {}};
  const Finding finding = check_port(port_at(terminal.slave_name), stranger);
  EXPECT_EQ(finding.severity, Severity::fault);
  EXPECT_TRUE(holds(finding.found, "stranger may not")) << finding.found;
  EXPECT_EQ(finding.mend, "sudo usermod -aG " + group_of(terminal.slave_name) + " stranger, then log in again");
}

/// A made-up /proc and /etc of a machine where somebody listens at port 2947 (0B83).
class DoctorStatusPort : public testing::Test {
 protected:
  DoctorStatusPort() {
    fs::create_directories(folder_ / "proc/net");
    fs::create_directories(folder_ / "etc/systemd/system/sockets.target.wants");
    std::ofstream(folder_ / "proc/net/tcp") << kHead << line("0100007F:0016", "0A", "11");
    std::ofstream(folder_ / "proc/net/tcp6") << kHead;
  }
  void listen(const std::string& program, const char* table = "tcp") const {
    std::ofstream(folder_ / "proc/net" / table, std::ios::app) << line("0100007F:0B83", "0A", "4711");
    if (program.empty()) return;
    fs::create_directories(folder_ / "proc/812/fd");
    std::ofstream(folder_ / "proc/812/comm") << program << '\n';
    fs::create_symlink("socket:[4711]", folder_ / "proc/812/fd/7");
  }
  void enable(const std::string& unit) const {
    std::ofstream(folder_ / "etc/systemd/system/sockets.target.wants" / unit) << "";
  }
  [[nodiscard]] Finding check() const { return check_status_port({}, folder_ / "proc", folder_ / "etc"); }
  static std::string line(const std::string& local, const std::string& state, const std::string& inode) {
    return "   0: " + local + " 00000000:0000 " + state +
           " 00000000:00000000 00:00000000 00000000     0        0 " + inode +
           " 1 0000000000000000 100 0 0 10 0\n";
  }
  static constexpr const char* kHead = "  sl  local_address rem_address   st tx_queue rx_queue tr tm->when\n";

  navcal::test::TemporaryFolder folder_;
};

TEST_F(DoctorStatusPort, FreeUnlessSomebodyListens) {
  std::ofstream(folder_ / "proc/net/tcp", std::ios::app) << line("0100007F:0B83", "01", "4711") << "nonsense\n";
  EXPECT_EQ(check().severity, Severity::good) << "a connection from that port is nobody who listens";
  EXPECT_EQ(check().found, "TCP port 2947 is free");
}

TEST_F(DoctorStatusPort, OurDaemonMayHaveItInEitherTable) {
  listen("navcald", "tcp6");
  EXPECT_EQ(check().severity, Severity::good);
  EXPECT_TRUE(holds(check().found, "navcald"));
}

TEST_F(DoctorStatusPort, GpsdIsAFaultWithTheCommandThatEndsIt) {
  listen("gpsd");
  EXPECT_EQ(check().severity, Severity::fault);
  EXPECT_TRUE(holds(check().mend, "systemctl disable --now gpsd.socket"));
}

TEST_F(DoctorStatusPort, SystemdListensForWhomIsEnabled) {
  listen("systemd");
  enable("gpsd.socket");
  EXPECT_EQ(check().severity, Severity::fault);
  enable("navcald.socket");
  EXPECT_EQ(check().severity, Severity::fault);
  EXPECT_TRUE(holds(check().found, "both"));
  fs::remove(folder_ / "etc/systemd/system/sockets.target.wants/gpsd.socket");
  EXPECT_EQ(check().severity, Severity::good);
}

TEST_F(DoctorStatusPort, WhoCannotBeSeenIsNotGuessed) {
  listen("");
  EXPECT_EQ(check().severity, Severity::warning);
  EXPECT_TRUE(holds(check().mend, "sudo"));
}

TEST(DoctorStatusPortHere, AListenerOfThisMachineIsFound) {
  const int listener = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t length = sizeof address;
  ASSERT_EQ(::bind(listener, reinterpret_cast<sockaddr*>(&address), length), 0);
  ASSERT_EQ(::listen(listener, 1), 0);
  ASSERT_EQ(::getsockname(listener, reinterpret_cast<sockaddr*>(&address), &length), 0);
  config::StatusSettings settings;
  settings.port = ntohs(address.sin_port);
  const Finding taken = check_status_port(settings);
  ::close(listener);
  EXPECT_EQ(taken.severity, Severity::fault) << taken.found;
  EXPECT_TRUE(holds(taken.found, "is taken by ")) << taken.found;
  EXPECT_EQ(check_status_port(settings).severity, Severity::good);
}

class DoctorLogFolder : public testing::Test {
 protected:
  DoctorLogFolder() {
    settings_.directory = folder_.path();
    settings_.rotate_bytes = settings_.free_floor_bytes = 0;
    settings_.sync_interval_s = 1e9;
  }
  [[nodiscard]] Finding check() const { return check_log_folder(settings_, own_account()); }

  navcal::test::TemporaryFolder folder_;
  config::LogSettings settings_;
};

TEST_F(DoctorLogFolder, ItsSpeedIsMeasuredAndNothingIsLeftBehind) {
  const Finding finding = check();
  EXPECT_EQ(finding.severity, Severity::good) << finding.found;
  EXPECT_TRUE(holds(finding.found, "safe after")) << finding.found;
  EXPECT_TRUE(fs::is_empty(folder_.path()));
}

TEST_F(DoctorLogFolder, OneThatIsNotThereIsAFault) {
  settings_.directory = folder_ / "absent";
  EXPECT_EQ(check().severity, Severity::fault);
  EXPECT_TRUE(holds(check().mend, "install -d")) << check().mend;
  settings_.enabled = false;
  EXPECT_EQ(check().severity, Severity::good) << "nobody asked for a log";
}

TEST_F(DoctorLogFolder, OneOfSomebodyElseIsAFault) {
  const Finding finding = check_log_folder(settings_, {"stranger", 54321, {}});
  EXPECT_EQ(finding.severity, Severity::fault);
  EXPECT_TRUE(holds(finding.mend, "chown stranger")) << finding.mend;
}

TEST_F(DoctorLogFolder, TheShippedUnitMustBeAllowedToWriteThere) {
  const navcal::test::TemporaryFolder etc;
  const Account service{kServiceUser, ::geteuid(), {}};
  const Finding closed = check_log_folder(settings_, service, etc.path());
  EXPECT_EQ(closed.severity, Severity::fault);
  for (const char* key : {"ReadWritePaths=", "RequiresMountsFor="})
    EXPECT_TRUE(holds(closed.mend, key + folder_.path().string())) << closed.mend;
  const fs::path drop_ins = etc / "systemd/system/navcald.service.d";
  fs::create_directories(drop_ins);
  std::ofstream(drop_ins / "card.conf")
      << "[Service]\nReadWritePaths=/nowhere " << folder_.path().string() << "x\n";
  EXPECT_EQ(check_log_folder(settings_, service, etc.path()).severity, Severity::fault) << "another folder";
  std::ofstream(drop_ins / "card.conf") << "[Service]\nReadWritePaths=" << folder_.path().string() << "\n";
  EXPECT_EQ(check_log_folder(settings_, service, etc.path()).severity, Severity::good);
  EXPECT_EQ(check_log_folder(settings_, {"somebody", ::geteuid(), {}}, etc / "none").severity, Severity::good)
      << "no service";
}

TEST_F(DoctorLogFolder, TheDropInIsWrittenOnceAndNothingIsOverwritten) {
  const navcal::test::TemporaryFolder etc;
  const Account service{kServiceUser, ::geteuid(), {}};
  const fs::path drop_ins = etc / "systemd/system/navcald.service.d";
  EXPECT_EQ(fix_log_folder(settings_, {"somebody", ::geteuid(), {}}, etc.path()).severity, Severity::good);
  EXPECT_FALSE(fs::exists(drop_ins)) << "no service";
  const Finding fixed = fix_log_folder(settings_, service, etc.path());
  EXPECT_EQ(fixed.severity, Severity::good) << fixed.found;
  ASSERT_TRUE(fs::exists(drop_ins));
  const fs::path file = fs::directory_iterator(drop_ins)->path();
  EXPECT_TRUE(holds(fixed.found, file.string())) << fixed.found;
  EXPECT_TRUE(holds(fixed.found, "daemon-reload")) << fixed.found;
  const std::string folder = folder_.path().string();
  EXPECT_EQ(navcal::test::read_file(file),
            "[Unit]\nRequiresMountsFor=" + folder + "\n\n[Service]\nReadWritePaths=" + folder + "\n");
  EXPECT_EQ(check_log_folder(settings_, service, etc.path()).severity, Severity::good);
  EXPECT_TRUE(holds(fix_log_folder(settings_, service, etc.path()).found, "nothing to write"));
  std::ofstream(file) << "# mine\n";
  EXPECT_EQ(fix_log_folder(settings_, service, etc.path()).severity, Severity::fault);
  EXPECT_EQ(navcal::test::read_file(file), "# mine\n");
  settings_.directory = folder_ / "a card";
  EXPECT_EQ(fix_log_folder(settings_, service, etc.path()).severity, Severity::fault) << "systemd reads two paths";
}

TEST_F(DoctorLogFolder, TooLittleRoomAndTooSlowAMediumAreWarnings) {
  settings_.sync_interval_s = 0;
  EXPECT_EQ(check().severity, Severity::warning);
  EXPECT_TRUE(holds(check().mend, "sync_interval_s")) << check().mend;
  settings_.free_floor_bytes = std::uint64_t{1} << 62;
  EXPECT_EQ(check().severity, Severity::warning);
  EXPECT_TRUE(holds(check().found, "are free")) << check().found;
  EXPECT_TRUE(fs::is_empty(folder_.path()));
}

TEST(DoctorSystem, AClockThatNobodySetsIsAWarning) {
  EXPECT_EQ(judge_clock({true, 0.004}).severity, Severity::good);
  EXPECT_TRUE(holds(judge_clock({true, 0.004}).found, "4 ms"));
  EXPECT_EQ(judge_clock({false, 16}).severity, Severity::warning);
  EXPECT_NE(check_clock().severity, Severity::fault);
}

TEST(DoctorSystem, DescriptorsForAllClientsAndPorts) {
  config::Settings settings;
  settings.status.max_clients = 1000;
  settings.ports.resize(4);
  EXPECT_EQ(judge_limits(1024, 0, settings).severity, Severity::warning);
  EXPECT_TRUE(holds(judge_limits(1024, 0, settings).mend, "ulimit -n 1036"));
  EXPECT_EQ(judge_limits(1036, 0, settings).severity, Severity::good);
}

}  // namespace
}  // namespace navcal::cli
