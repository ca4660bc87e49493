// SPDX-License-Identifier: Apache-2.0
#include "fleet/make_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <system_error>
#include <tuple>

#include "base/failure.h"
#include "base/interruptible.h"
#include "base/parallel.h"
#include "config/complaints.h"
#include "config/layout/layout_file.h"
#include "config/load.h"
#include "config/vehicle_file.h"
#include "diagnosis/diagnose_layout.h"
#include "fleet/catalogue.h"
#include "fleet/jobs.h"
#include "fleet/plan.h"
#include "fleet/result_store.h"
#include "fleet/whole_writing.h"
#include "record/content_hash.h"

namespace navcal::fleet {
namespace {

namespace fs = std::filesystem;
using PlanProgress = std::function<void(std::string_view what, double done)>;

/// Digits of a hash that name a bank.
constexpr std::size_t kBankDigits = 16;

void expect_no_interruption() {
  if (base::Interruptible::interrupted()) {
    throw base::Failure(base::Exit::failed, "interrupted; nothing was planned");
  }
}

/// work(i) for all i on several threads, with progress.
template <class Work>
void in_parallel_with_progress(unsigned threads, std::size_t count, std::string_view what,
                               const PlanProgress& progress, Work work) {
  std::mutex mutex;
  std::size_t done = 0;
  base::in_parallel(threads, count, [&](std::size_t i) {
    expect_no_interruption();
    work(i);
    const std::lock_guard lock(mutex);
    progress(what, static_cast<double>(++done) / static_cast<double>(count));
  });
}

std::string key_of(const Task& task) {
  return record::sha256_of(fmt::format(
      "navcal {}\njob {}\nrecording {}\nvehicle {}\nconfiguration {}\nbank {} {} {}\n", NAVCAL_VERSION, task.job,
      task.recording, task.vehicle, task.configuration, task.bank, task.bank_missions, task.bank_seed));
}

/// What tells two tasks apart but for the bank, which follows from the rest.
using TaskIdentity = std::tuple<std::string, std::string, std::string, std::string, int, std::uint64_t>;

TaskIdentity identity_of(const Task& task) {
  return {task.job, task.recording, task.vehicle, task.configuration, task.bank_missions, task.bank_seed};
}

class Planner {
 public:
  Planner(const PlanRequest& request, const PlanProgress& progress, Database& database)
      : request_(request), progress_(progress), database_(database) {
    for (const std::string& name : request.jobs) jobs_.push_back(&job_named(name));
    if (!request.config.empty()) settings_ = config::load(request.config);
    if (settings_) {
      const std::string toml = config::to_toml(*settings_);
      configuration_ = record::sha256_of(toml);
      Statement(database, "INSERT OR IGNORE INTO configurations VALUES(?1, ?2, ?3)")
          .run(configuration_, request.config.string(), toml);
    }
  }

  PlanSummary make() {
    find_files();
    forget_dead_banks();
    for (const Task& task : read_tasks(database_)) {
      known_.insert(identity_of(task));
      keys_.insert(task.key);
      next_number_ = std::max(next_number_, task.number + 1);
    }
    std::vector<Task> wanted = new_tasks();
    assign_banks(wanted);
    for (const Task& task : bank_tasks_) add(task);
    for (Task& task : wanted) {
      task.key = key_of(task);
      add(task);
    }
    return summary_;
  }

 private:
  /// Files of this folder and those of earlier plans that are still there; only new and changed ones are read.
  void find_files() {
    scan_ = scan(request_.recordings);
    summary_.files = scan_.files.size();
    std::map<std::string, RecordingFile> known;
    for (RecordingFile& file : read_files(database_)) known.emplace(file.path, std::move(file));
    std::vector<RecordingFile*> unread;
    for (RecordingFile& file : scan_.files) {
      const auto before = known.find(file.path);
      if (before != known.end() && before->second.bytes == file.bytes &&
          before->second.modified_ns == file.modified_ns) {
        file.recording = before->second.recording;
      } else {
        unread.push_back(&file);
      }
    }
    for (const fs::path& nominal : request_.nominals) {
      RecordingFile& file = nominals_.emplace_back();
      file.path = fs::absolute(nominal).lexically_normal().string();
      if (!look_at(file)) throw base::Failure(base::Exit::bad_input, nominal.string() + ": no such file");
    }
    for (RecordingFile& file : nominals_) unread.push_back(&file);
    hash(unread);
    std::erase_if(scan_.files, [](const RecordingFile& file) { return file.recording.empty(); });
    for (const RecordingFile& file : nominals_)
      if (file.recording.empty()) throw base::Failure(base::Exit::bad_input, summary_.remarks.back());
    std::map<std::string, RecordingFile> all;
    for (const auto& [path, file] : known) {
      RecordingFile now = file;
      if (look_at(now)) {
        all.emplace(path, file);
      } else {
        ++summary_.gone;
      }
    }
    for (const auto* found : {&nominals_, &scan_.files})
      for (const RecordingFile& file : *found) all[file.path] = file;
    std::vector<RecordingFile> files;
    for (auto& [path, file] : all) {
      recordings_.emplace(file.recording, file.path);
      files.push_back(std::move(file));
    }
    summary_.recordings = recordings_.size();
    write_files(database_, files);
  }

  void hash(const std::vector<RecordingFile*>& files) {
    summary_.read = files.size();
    std::mutex mutex;
    in_parallel_with_progress(request_.threads, files.size(), "reading recordings", progress_, [&](std::size_t i) {
      try {
        files[i]->recording = record::sha256_of_file(files[i]->path);
      } catch (const std::system_error& error) {
        const std::lock_guard lock(mutex);
        summary_.remarks.push_back(std::string(error.what()) + "; it is left out");
      }
    });
  }

  /// Forgets banks that are not made and whose recording is gone, with the tasks that wait for them.
  void forget_dead_banks() {
    const ResultStore results(request_.plan);
    for (const Task& task : read_tasks(database_)) {
      if (!task.makes_bank() || recordings_.contains(task.recording) ||
          results.state_of(task) != TaskState::open) {
        continue;
      }
      for (const Task& user : read_tasks(database_)) {
        if (user.bank == task.bank && results.state_of(user) == TaskState::open) {
          Statement(database_, "DELETE FROM tasks WHERE task=?1").run(user.number);
        }
      }
      Statement(database_, "DELETE FROM banks WHERE bank=?1").run(task.bank);
    }
  }

  struct PlannedVehicle {
    std::string key;  ///< hash of its TOML, and of the nominal recordings of a layout
    bool is_layout = false;
  };
  /// The vehicle of a recording, which the catalogue then has.
  const PlannedVehicle& vehicle_of(const fs::path& recording) {
    const fs::path file = request_.vehicle.empty() ? scan_.vehicle_of(recording) : request_.vehicle;
    const auto [found, is_new] = vehicles_.try_emplace(file);
    if (!is_new) return found->second;
    std::string toml = file.empty() ? config::vehicle_file({}) : config::content_of(file);
    PlannedVehicle vehicle{{}, config::is_layout(toml)};
    toml = vehicle.is_layout ? config::layout_file(config::parse_layout(toml, file.native()))
                             : config::vehicle_file(config::parse_vehicle(toml, file.native()));
    if (!vehicle.is_layout && !nominals_.empty()) {
      toml = config::layout_file(diagnosis::layout_of(config::parse_vehicle(toml, file.native())));
      vehicle.is_layout = true;
    }
    std::string keyed = toml;
    for (const RecordingFile& nominal : nominals_) keyed += nominal.recording;
    vehicle.key = record::sha256_of(keyed);
    Statement(database_, "INSERT OR IGNORE INTO vehicles VALUES(?1, ?2, ?3)")
        .run(vehicle.key, file.empty() ? "the reference vehicle" : file.string(), toml);
    Statement insert(database_, "INSERT OR IGNORE INTO nominals VALUES(?1, ?2)");
    for (const RecordingFile& nominal : nominals_) insert.run(vehicle.key, nominal.recording);
    return found->second = vehicle;
  }

  std::vector<Task> new_tasks() {
    std::vector<Task> wanted;
    for (const RecordingFile& file : scan_.files) {
      for (const Job* job : jobs_) {
        Task task;
        task.job = job->name;
        task.recording = file.recording;
        task.configuration = configuration_;
        const PlannedVehicle vehicle = job->uses_vehicle ? vehicle_of(file.path) : PlannedVehicle{};
        task.vehicle = vehicle.key;
        if (vehicle.is_layout && std::ranges::count(nominals_, file.recording, &RecordingFile::recording) > 0)
          continue;
        if (job->uses_bank) {
          task.bank_missions = vehicle.is_layout ? 0 : request_.bank_missions;
          task.bank_seed = request_.bank_seed;
        }
        if (known_.insert(identity_of(task)).second) wanted.push_back(std::move(task));
      }
    }
    return wanted;
  }

  /// Gives each task that uses a null bank one that serves it: one of the catalogue, one that another task here
  /// needs as well, or a new one, which is made of its own recording.
  void assign_banks(std::vector<Task>& tasks) {
    std::vector<Task*> users;
    for (Task& task : tasks) {
      if (job_named(task.job).uses_bank && task.bank_missions > 0) users.push_back(&task);
    }
    std::vector<gap::MissionOutline> outlines(users.size());
    in_parallel_with_progress(request_.threads, users.size(), "comparing missions", progress_,
                              [&](std::size_t i) { outlines[i] = outline_of(users[i]->recording); });
    std::vector<PlannedBank> banks = read_banks(database_);
    for (std::size_t i = 0; i < users.size(); ++i) {
      if (outlines[i].features.empty()) continue;  // the task itself will say why
      users[i]->bank = bank_for(*users[i], outlines[i], banks);
    }
  }

  [[nodiscard]] gap::MissionOutline outline_of(const std::string& recording) const {
    try {
      return gap::outline_of(gap::load_mission(
          recordings_.at(recording), [](double) {}, settings_));
    } catch (const base::Failure&) {
      throw;
    } catch (const std::exception&) {
      return {};  // a recording that cannot be read: its task says why
    }
  }

  std::string bank_for(const Task& task, const gap::MissionOutline& outline, std::vector<PlannedBank>& banks) {
    for (const PlannedBank& bank : banks) {
      if (bank.vehicle == task.vehicle && bank.configuration == task.configuration &&
          bank.missions == task.bank_missions && bank.seed == task.bank_seed &&
          gap::are_alike(bank.outline, outline)) {
        return bank.bank;
      }
    }
    Task maker = task;
    maker.job = kBankJob;
    maker.bank.clear();
    maker.bank = key_of(maker).substr(0, kBankDigits);
    maker.key = key_of(maker);
    PlannedBank bank{maker.bank,         task.recording, task.vehicle, task.configuration,
                     task.bank_missions, task.bank_seed, outline};
    add_bank(database_, bank);
    banks.push_back(std::move(bank));
    std::string key = maker.bank;
    bank_tasks_.push_back(std::move(maker));
    return key;
  }

  void add(Task task) {
    if (!keys_.insert(task.key).second) return;
    task.number = next_number_++;
    add_task(database_, task);
    ++summary_.added;
  }

  const PlanRequest& request_;
  const PlanProgress& progress_;
  Database& database_;
  std::vector<const Job*> jobs_;
  std::optional<config::Settings> settings_;
  std::string configuration_;
  FolderScan scan_;
  std::map<std::string, std::string> recordings_;  ///< path by hash
  std::vector<RecordingFile> nominals_;
  std::map<fs::path, PlannedVehicle> vehicles_;
  std::set<TaskIdentity> known_;
  std::set<std::string> keys_;
  std::vector<Task> bank_tasks_;
  int next_number_ = 1;
  PlanSummary summary_;
};

}  // namespace

PlanSummary make_plan(const PlanRequest& request, const PlanProgress& progress) {
  fs::create_directories(request.plan);
  const PlanLock lock(request.plan);
  const fs::path catalogue = catalogue_of(request.plan), part = part_of(catalogue);
  fs::remove(part);
  if (fs::exists(catalogue)) fs::copy_file(catalogue, part);
  try {
    PlanSummary summary;
    {
      Database database(part, Database::Access::create);
      make_catalogue(database, catalogue.string());
      database.execute("BEGIN");
      summary = Planner(request, progress, database).make();
      database.execute("COMMIT");
    }
    rename_whole(part, catalogue);
    const Plan plan = load_plan(request.plan);
    summary.tasks = plan.tasks.size();
    for (const Task& task : plan.tasks) summary.banks += task.makes_bank() ? 1U : 0U;
    return summary;
  } catch (const DatabaseError& error) {
    fs::remove(part);
    throw base::Failure(base::Exit::failed, error.what());
  } catch (const std::invalid_argument& error) {
    fs::remove(part);
    throw base::Failure(base::Exit::usage, error.what());
  } catch (...) {
    fs::remove(part);
    throw;
  }
}

}  // namespace navcal::fleet
