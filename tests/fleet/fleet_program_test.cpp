// SPDX-License-Identifier: Apache-2.0
// navcal fleet as a user runs it: on this machine, and with the commands of a small Slurm of the tests
// (tests/fleet/fake_slurm). tests/fleet/slurm.py does the same with a real one.
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <tuple>

#include "tests/fleet/fleet_folder.h"
#include "tests/gap/simulated_mission.h"
#include "tests/support/process.h"

namespace navcal::fleet {
namespace {

namespace fs = std::filesystem;
using navcal::test::eventually;
using navcal::test::Process;
using navcal::test::read_file;

constexpr std::chrono::seconds kFleetPatience{120};

class FleetProgram : public testing::Test {
 protected:
  FleetProgram() {
    fs::create_directories(folder_ / "queue");
    ::setenv("FAKE_SLURM", (folder_ / "queue").c_str(), 1);
    const char* const path = std::getenv("PATH");
    path_ = path == nullptr ? "" : path;
    ::setenv("PATH", (NAVCAL_SOURCE_DIR "/tests/fleet/fake_slurm:" + path_).c_str(), 1);
  }
  ~FleetProgram() override { ::setenv("PATH", path_.c_str(), 1); }

  void add_recordings(int count) const {
    for (int i = 0; i < count; ++i) folder_.add_recording(std::to_string(i) + ".cap", i);
  }
  std::unique_ptr<Process> start(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {NAVCAL_PROGRAM, "fleet"});
    return started(arguments);
  }
  std::unique_ptr<Process> started(const std::vector<std::string>& command) {
    return std::make_unique<Process>(command, folder_ / ("run" + std::to_string(++runs_)));
  }
  /// Runs it to its end; its exit status.
  int run(std::vector<std::string> arguments) { return ended(start(std::move(arguments))); }
  int run_trial(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), FLEET_TRIAL);
    return ended(started(arguments));
  }
  int ended(const std::unique_ptr<Process>& process) {
    const int status = process->wait(kFleetPatience).value_or(-1);
    out_ = process->out();
    err_ = process->err();
    return status;
  }
  void plan(const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"plan", folder_.recordings().string(), "-o", folder_.plan().string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    ASSERT_EQ(run(arguments), 0) << err_;
  }
  [[nodiscard]] std::vector<std::string> by_slurm() const {
    return {"submit", folder_.plan().string(), "--slurm", "--poll", "0.1"};
  }
  /// Calls of sbatch.
  [[nodiscard]] std::ptrdiff_t submissions() const {
    const std::string calls = read_file(folder_ / "queue.calls");
    return std::count(calls.begin(), calls.end(), '\n');
  }
  std::string merged(const std::string& name) {
    EXPECT_EQ(run({"merge", folder_.plan().string(), "-o", (folder_ / name).string()}), 0) << err_;
    return read_file(folder_ / name);
  }

  test::FleetFolder folder_;
  std::string path_, out_, err_;
  int runs_ = 0;
};

TEST_F(FleetProgram, PlansRunsListsAndMerges) {
  add_recordings(5);
  folder_.add_file("poison.cap", "#capture 1\npoison\n");
  plan({"--job", "calibrate"});
  EXPECT_NE(out_.find("6 tasks (6 new)"), std::string::npos) << out_;
  EXPECT_EQ(run({"submit", folder_.plan().string(), "--local", "--jobs", "2"}), 0) << err_;
  EXPECT_NE(out_.find("6 tasks: 5 done, 1 failed, 0 open"), std::string::npos) << out_;
  EXPECT_NE(err_.find("poison.cap:2"), std::string::npos) << err_;
  const std::string local = merged("local.sqlite");
  fs::remove_all(folder_.plan() / "results");
  for (const char* task : {"6", "2-5", "1"}) {
    EXPECT_EQ(run({"run", folder_.plan().string(), "--task", task}), 0) << err_;
  }
  EXPECT_EQ(merged("serial.sqlite"), local);
  EXPECT_EQ(run({"list", folder_.plan().string(), "--json"}), 0);
  const auto first = nlohmann::json::parse(out_.substr(0, out_.find('\n')));
  EXPECT_EQ(first["class"], "TASK");
  EXPECT_EQ(first["state"], "done");
  EXPECT_EQ(run({"merge", folder_.plan().string(), "--report", (folder_ / "fleet.html").string()}), 0) << err_;
  EXPECT_NE(read_file(folder_ / "fleet.html").find("poison.cap"), std::string::npos);
}

TEST_F(FleetProgram, WrongUsageAndBadInputHaveTheirStatuses) {
  EXPECT_EQ(run({}), 2);
  EXPECT_EQ(run({"plan", (folder_ / "nowhere").string(), "-o", folder_.plan().string()}), 3);
  EXPECT_EQ(run({"list", (folder_ / "nowhere").string()}), 3);
  add_recordings(1);
  plan({"--job", "calibrate"});
  EXPECT_EQ(run({"plan", folder_.recordings().string(), "-o", folder_.plan().string(), "--job", "bank"}), 2);
  EXPECT_EQ(run({"submit", folder_.plan().string()}), 2);
  EXPECT_EQ(run({"submit", folder_.plan().string(), "--local", "--slurm"}), 2);
  EXPECT_EQ(run({"run", folder_.plan().string(), "--task", "2"}), 2);
  EXPECT_EQ(run({"run", folder_.plan().string(), "--task", "x"}), 2);
  const std::string catalogue = (folder_.plan() / "plan.sqlite").string();
  EXPECT_EQ(run({"merge", folder_.plan().string(), "-o", catalogue}), 2);
  EXPECT_EQ(run({"merge", folder_.plan().string(), "-o", "/dev/null"}), 2);
  EXPECT_NE(err_.find("/dev/null: a database needs an ordinary file"), std::string::npos) << err_;
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST_F(FleetProgram, MissionsSteeredAlikeShareABankAndTheirAnswersAreThoseOfASerialRun) {
  for (const auto& [name, mission, seed] :
       {std::tuple{"a.cap", "identification", 1}, std::tuple{"b.cap", "identification", 2},
        std::tuple{"c.cap", "thesis1", 3}}) {
    fs::create_directories(folder_.recordings());
    gap::test::write_mission(folder_.recordings() / name, mission, "", 60, static_cast<std::uint64_t>(seed));
  }
  plan({"--job", "gap", "--bank", "20"});
  EXPECT_NE(out_.find("5 tasks (5 new), 2 of them null banks"), std::string::npos) << out_;
  ASSERT_EQ(run({"submit", folder_.plan().string(), "--local", "--jobs", "2"}), 0) << err_;
  const std::string local = merged("local.sqlite");
  fs::remove_all(folder_.plan() / "results");
  fs::remove_all(folder_.plan() / "banks");
  EXPECT_EQ(run({"run", folder_.plan().string(), "--task", "3"}), 1) << "its bank is not made";
  for (const char* task : {"2", "1", "5", "4", "3"}) {
    ASSERT_EQ(run({"run", folder_.plan().string(), "--task", task, "--threads", "2"}), 0) << err_;
  }
  EXPECT_EQ(merged("serial.sqlite"), local);
}

TEST_F(FleetProgram, RecordingsOfALayoutAreDiagnosedBesideTheNominalOnes) {
  const std::string layout = NAVCAL_SOURCE_DIR "/share/vehicles/micro-auv.toml";
  fs::create_directories(folder_.recordings());
  const auto simulate = [&](const fs::path& file, const char* seed, const char* effect) {
    ASSERT_EQ(ended(started({NAVCAL_PROGRAM, "simulate", "--vehicle", layout, "--mission", "survey", "--seconds",
                             "40", "--seed", seed, "--effect", effect, "-o", file.string()})),
              0)
        << err_;
  };
  simulate(folder_ / "n1.cap", "1", "thrust_scale=0");
  simulate(folder_.recordings() / "n2.cap", "2", "thrust_scale=0");
  simulate(folder_.recordings() / "weak.cap", "3", "thrust_scale@thruster.1=4");
  const std::string first = (folder_ / "n1.cap").string(), second = (folder_.recordings() / "n2.cap").string();
  plan({"--vehicle", layout, "--nominal", first, "--nominal", second});
  EXPECT_NE(out_.find("1 tasks (1 new), 0 of them null banks"), std::string::npos) << out_;
  ASSERT_EQ(run({"submit", folder_.plan().string(), "--local"}), 0) << err_;
  const std::string merged_file = merged("layout.sqlite");
  EXPECT_NE(merged_file.find("thrust_scale of thruster.1"), std::string::npos);
  // Another floor is another diagnosis.
  plan({"--vehicle", layout, "--nominal", first});
  EXPECT_NE(out_.find("2 new"), std::string::npos) << out_;
}

// Evidence was for vehicle files only.
TEST_F(FleetProgram, MissionsOfALayoutTellTogetherWhichThrusterIsWeak) {
  const std::string layout = NAVCAL_SOURCE_DIR "/share/vehicles/micro-auv.toml";
  fs::create_directories(folder_.recordings() / "rov7");
  const auto simulate = [&](const fs::path& file, const char* seed, const char* effect) {
    ASSERT_EQ(ended(started({NAVCAL_PROGRAM, "simulate", "--vehicle", layout, "--mission", "survey", "--seconds",
                             "40", "--seed", seed, "--effect", effect, "-o", file.string()})),
              0)
        << err_;
  };
  simulate(folder_ / "n1.cap", "1", "thrust_scale=0");
  simulate(folder_ / "n2.cap", "2", "thrust_scale=0");
  std::ofstream(folder_ / "weak.toml") << "[thrust_scale]\nof = \"thruster.1\"\nscale = -0.2\n";
  for (const char* const seed : {"3", "4"}) {
    ASSERT_EQ(ended(started({NAVCAL_PROGRAM, "simulate", "--vehicle", layout, "--mission", "survey", "--seconds",
                             "40", "--seed", seed, "--effects", (folder_ / "weak.toml").string(), "-o",
                             (folder_.recordings() / "rov7" / (std::string(seed) + ".cap")).string()})),
              0)
        << err_;
  }
  plan({"--vehicle", layout, "--nominal", (folder_ / "n1.cap").string(), "--nominal",
        (folder_ / "n2.cap").string(), "--job", "evidence"});
  EXPECT_NE(out_.find("2 tasks (2 new), 0 of them null banks"), std::string::npos) << out_;
  ASSERT_EQ(run({"submit", folder_.plan().string(), "--local"}), 0) << err_;
  ASSERT_EQ(run({"causes", folder_.plan().string()}), 0) << err_;
  EXPECT_NE(out_.find("thrust_scale of thruster.1 of vehicle rov7: scale -0."), std::string::npos) << out_;
}

TEST_F(FleetProgram, SlurmDoesAllTasksInArraysOfTheSizeItTakes) {
  add_recordings(7);
  plan({"--job", "calibrate"});
  ASSERT_EQ(run(by_slurm()), 0) << out_ << err_;
  EXPECT_NE(out_.find("7 tasks: 7 done"), std::string::npos) << out_;
  EXPECT_EQ(submissions(), 3) << "arrays of at most 3 elements";
  ASSERT_EQ(run(by_slurm()), 0);
  EXPECT_EQ(submissions(), 3) << "nothing is left to do";
}

TEST_F(FleetProgram, AnInterruptedClientGoesOnWithWhatIsInTheQueue) {
  add_recordings(3);
  plan({"--job", "calibrate"});
  std::ofstream(folder_ / "queue/held") << "";
  const auto client = start(by_slurm());
  ASSERT_TRUE(eventually([&] { return submissions() == 1; }, kFleetPatience));
  client->signal(SIGINT);
  EXPECT_EQ(client->wait(kFleetPatience), 1);
  EXPECT_NE(client->err().find("goes on"), std::string::npos) << client->err();
  // Of two clients at a time, the one that is later to take the lock is refused, whichever was started first.
  const auto one = start(by_slurm()), other = start(by_slurm());
  const auto is_refused = [](Process& client_of_two) { return client_of_two.wait(std::chrono::seconds(0)) == 1; };
  EXPECT_TRUE(eventually([&] { return is_refused(*one) || is_refused(*other); }, kFleetPatience));
  EXPECT_FALSE(is_refused(*one) && is_refused(*other));
  for (Process* const each : {one.get(), other.get()}) {
    each->signal(SIGKILL);
    (void)each->wait(kFleetPatience);
  }
  fs::remove(folder_ / "queue/held");
  ASSERT_EQ(run(by_slurm()), 0) << err_;
  EXPECT_EQ(submissions(), 1);
}

TEST_F(FleetProgram, AControllerThatDoesNotAnswerIsWaitedFor) {
  add_recordings(2);
  plan({"--job", "calibrate"});
  std::ofstream(folder_ / "queue/silent") << "";
  const auto client = start(by_slurm());
  EXPECT_FALSE(client->wait(std::chrono::seconds(1)));
  fs::remove(folder_ / "queue/silent");
  EXPECT_EQ(client->wait(kFleetPatience), 0) << client->err();
}

TEST_F(FleetProgram, ATaskWithoutAResultIsTriedAgainAndGivenUp) {
  add_recordings(2);
  plan({"--job", "calibrate"});
  std::vector<std::string> command = by_slurm();
  command.insert(command.end(), {"--program", "/bin/false", "--attempts", "2"});
  EXPECT_EQ(run(command), 1);
  EXPECT_EQ(submissions(), 2);
  EXPECT_NE(err_.find("task 1: no result after 2 attempts: CANCELLED, OUT_OF_MEMORY"), std::string::npos) << err_;
  EXPECT_NE(err_.find("2 tasks have no result"), std::string::npos) << err_;
  EXPECT_EQ(run(by_slurm()), 0) << err_;
}

TEST_F(FleetProgram, WithoutSlurmTheCommandSaysSo) {
  add_recordings(1);
  plan({"--job", "calibrate"});
  ::setenv("PATH", (folder_ / "empty").c_str(), 1);
  EXPECT_EQ(run(by_slurm()), 1);
  EXPECT_NE(err_.find("not installed"), std::string::npos) << err_;
}

TEST_F(FleetProgram, TellsWhatItsMissionsSayTogether) {
  for (const char* vehicle : {"one", "two"}) {
    fs::create_directories(folder_.recordings() / vehicle);
    for (int i = 0; i < 2; ++i) {
      gap::test::write_mission(folder_.recordings() / vehicle / ("m" + std::to_string(i) + ".cap"),
                               "identification",
                               std::string_view(vehicle) == "one" ? "[fin_gain]\nscale = 0.12\n" : "", 80,
                               static_cast<std::uint64_t>(10 * i + vehicle[0]));
    }
  }
  EXPECT_EQ(run({"causes", folder_.plan().string()}), 3) << "no plan yet";
  plan({"--job", "evidence,calibrate", "--bank", "12"});
  EXPECT_EQ(run({"causes", folder_.plan().string()}), 3) << "nothing is done yet";
  EXPECT_NE(err_.find("--job evidence"), std::string::npos) << err_;
  ASSERT_EQ(run({"submit", folder_.plan().string(), "--local"}), 0) << err_;
  const fs::path page = folder_ / "fleet.html";
  ASSERT_EQ(run({"causes", folder_.plan().string(), "--json", "-", "--report", page.string()}), 0) << err_;
  const auto answer = nlohmann::json::parse(out_);
  EXPECT_EQ(answer.at("missions").size(), 4U);
  EXPECT_EQ(answer.at("vehicles").size(), 2U);
  ASSERT_EQ(answer.at("causes").size(), 1U) << answer.at("causes");
  EXPECT_EQ(answer.at("causes")[0].at("name"), "fin_gain");
  EXPECT_EQ(answer.at("causes")[0].at("level"), "vehicle");
  EXPECT_EQ(answer.at("causes")[0].at("of"), "one");
  EXPECT_NE(read_file(page).find("fin_gain of vehicle one"), std::string::npos);
  ASSERT_EQ(run({"causes", folder_.plan().string()}), 0);
  EXPECT_NE(out_.find("fin_gain of vehicle one"), std::string::npos) << out_;
}

TEST_F(FleetProgram, RecordsAndScoresATrial) {
  const std::string truth = (folder_ / "truth.json").string(), missions = (folder_ / "missions").string();
  ASSERT_EQ(run_trial({"record", "-o", missions, "--truth", truth, "--vehicles", "2", "--days", "1", "--minutes",
                       "3", "--seed", "5"}),
            0)
      << err_;
  EXPECT_TRUE(fs::exists(missions + "/v02/day-01.cap"));
  EXPECT_EQ(run_trial({"record", "-o", missions, "--truth", truth, "--vehicles", "1"}), 1) << "not empty";
  folder_.add_file("answer.json",
                   R"({"causes":[],"undecided":[],"vehicles":[{"vehicle":"v01","verdict":"no-gap"}]})");
  ASSERT_EQ(run_trial({"score", (folder_.recordings() / "answer.json").string(), "--truth", truth}), 0) << err_;
  EXPECT_NE(out_.find("missed"), std::string::npos);
  EXPECT_EQ(run_trial({"score", truth, "--truth", truth}), 1);
}

}  // namespace
}  // namespace navcal::fleet
