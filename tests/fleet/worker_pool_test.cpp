// SPDX-License-Identifier: Apache-2.0
#include "fleet/worker_pool.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <map>
#include <thread>

#include "base/interruptible.h"
#include "fleet/whole_writing.h"
#include "tests/fleet/fleet_folder.h"

namespace navcal::fleet {
namespace {

namespace fs = std::filesystem;

class WorkerPool : public testing::Test {
 protected:
  void plan(int recordings) {
    for (int i = 0; i < recordings; ++i) folder_.add_recording(std::to_string(i) + ".cap", i);
    (void)folder_.make();
    plan_ = load_plan(folder_.plan());
    for (const Task& task : plan_.tasks) all_.push_back(&task);
  }
  void run(const PoolOptions& options) {
    run_in_processes(plan_, all_, options,
                     [&](const Task& task, const Attempt& attempt) { attempts_[task.number] = attempt; });
  }
  [[nodiscard]] int parts() const {
    int found = 0;
    for (const auto& entry : fs::recursive_directory_iterator(folder_.plan())) {
      found += entry.path().extension() == ".part" ? 1 : 0;
    }
    return found;
  }
  test::FleetFolder folder_;
  Plan plan_;
  std::vector<const Task*> all_;
  std::map<int, Attempt> attempts_;
};

TEST_F(WorkerPool, DoesAllTasks) {
  plan(7);
  run({3, 1});
  ASSERT_EQ(attempts_.size(), 7U);
  for (const auto& [number, attempt] : attempts_) EXPECT_EQ(attempt.state, TaskState::done) << attempt.why;
  EXPECT_EQ(ResultStore(plan_.folder).states().size(), 7U);
  EXPECT_TRUE(open_tasks(plan_, ResultStore(plan_.folder).states()).ready.empty());
}

TEST_F(WorkerPool, APoisonedRecordingCostsItsOwnTaskOnly) {
  folder_.add_file("poison.cap", "#capture 1\nnonsense\n");
  plan(4);
  run({2, 1});
  ASSERT_EQ(attempts_.size(), 5U);
  int failed = 0;
  for (const auto& [number, attempt] : attempts_) {
    if (attempt.state != TaskState::failed) continue;
    ++failed;
    EXPECT_NE(attempt.why.find("poison.cap:2"), std::string::npos) << attempt.why;
  }
  EXPECT_EQ(failed, 1);
}

TEST_F(WorkerPool, ACrashIsTheResultOfItsTaskAndASignalFromOutsideIsNone) {
  plan(3);
  const auto crash = [](const Plan& p, const Task& task, unsigned threads) {
    ::signal(SIGSEGV, SIG_DFL);
    if (task.number == 1) ::raise(SIGSEGV);
    if (task.number == 2) ::raise(SIGKILL);
    return run_task(p, task, threads);
  };
  run({2, 1, crash});
  EXPECT_EQ(attempts_[1].state, TaskState::failed);
  EXPECT_NE(attempts_[1].why.find("signal 11"), std::string::npos) << attempts_[1].why;
  EXPECT_EQ(attempts_[2].state, TaskState::open);
  EXPECT_EQ(attempts_[3].state, TaskState::done);
  run({1, 1});
  EXPECT_EQ(attempts_[1].state, TaskState::failed);
  EXPECT_EQ(attempts_[2].state, TaskState::done);
  ResultStore(plan_.folder).forget_error(plan_.tasks[0]);
  run({1, 1});
  EXPECT_EQ(attempts_[1].state, TaskState::done);
}

TEST_F(WorkerPool, AFileThatIsGoneOrChangedLeavesItsTaskOpen) {
  plan(2);
  fs::remove(plan_.recordings.at(plan_.tasks[0].recording).path);
  std::ofstream(plan_.recordings.at(plan_.tasks[1].recording).path) << "#capture 1\n";
  run({1, 1});
  EXPECT_EQ(attempts_[1].state, TaskState::open);
  EXPECT_NE(attempts_[1].why.find("gone"), std::string::npos);
  EXPECT_EQ(attempts_[2].state, TaskState::open);
  EXPECT_NE(attempts_[2].why.find("changed"), std::string::npos);
}

TEST_F(WorkerPool, AnInterruptionLeavesNothingHalfDone) {
  plan(6);
  const base::Interruptible interruptible;
  const auto slow = [&](const Plan& p, const Task& task, unsigned threads) {
    if (task.number <= 2) return run_task(p, task, threads);
    std::ofstream(part_of(p.folder / "results" / "00" / task.key)) << "half";
    for (;;) ::pause();
  };
  fs::create_directories(plan_.folder / "results" / "00");
  run_in_processes(plan_, all_, {2, 1, slow}, [&](const Task& task, const Attempt& attempt) {
    attempts_[task.number] = attempt;
    if (task.number == 2)
      std::thread([] {
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
        ::kill(::getpid(), SIGINT);
      }).detach();
  });
  EXPECT_TRUE(base::Interruptible::interrupted());
  EXPECT_EQ(attempts_.size(), 2U);
  EXPECT_EQ(open_tasks(plan_, ResultStore(plan_.folder).states()).ready.size(), 4U);
  EXPECT_EQ(parts(), 0);
}

TEST_F(WorkerPool, OnlyLeftoversOfProcessesThatEndedAreRemoved) {
  const fs::path mine = part_of(folder_ / "x");
  const fs::path other = folder_ / ".x.another-host.1.part";
  const std::string name = mine.filename().string(), pid = std::to_string(::getpid());
  const fs::path ended = folder_ / (name.substr(0, name.size() - pid.size() - 5) + "999999999.part");
  for (const fs::path& file : {mine, other, ended, folder_ / ".part", folder_ / "a.part"})
    std::ofstream(file) << "x";
  remove_leftovers(mine.parent_path());
  EXPECT_TRUE(fs::exists(mine));
  EXPECT_TRUE(fs::exists(other));
  EXPECT_FALSE(fs::exists(ended));
  EXPECT_TRUE(fs::exists(folder_ / ".part"));
  EXPECT_TRUE(fs::exists(folder_ / "a.part"));
}

}  // namespace
}  // namespace navcal::fleet
