// SPDX-License-Identifier: Apache-2.0
#include "fleet/catalogue.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <set>
#include <system_error>

#include "base/failure.h"

namespace navcal::fleet {

const char* catalogue_tables();  // catalogue.sql, which the build puts into the program

namespace {

constexpr int kCatalogueFormat = 1;

[[noreturn]] void fail_of_format(const std::string& name) {
  throw base::Failure(base::Exit::bad_input,
                      name + ": of another version of navcal; make the plan anew in another folder");
}

int format_of(Database& database) {
  Statement version(database, "PRAGMA user_version");
  version.step();
  return static_cast<int>(version.integer(0));
}

std::string outline_text(const gap::MissionOutline& outline) {
  return nlohmann::json{{"features", outline.features},
                        {"field_uT", outline.field_uT},
                        {"field_is_fitted", outline.field_is_fitted},
                        {"instruments", outline.instruments}}
      .dump();
}

gap::MissionOutline outline_from(const std::string& text) {
  try {
    const auto json = nlohmann::json::parse(text);
    gap::MissionOutline outline;
    outline.features = json.at("features").get<std::vector<double>>();
    outline.field_uT = json.at("field_uT").get<gap::Vector3>();
    outline.field_is_fitted = json.at("field_is_fitted");
    outline.instruments = json.at("instruments");
    return outline;
  } catch (const nlohmann::json::exception& error) {
    throw DatabaseError(std::string("plan.sqlite, table banks: ") + error.what());
  }
}

std::map<std::string, std::string> texts(Database& database, std::string_view sql) {
  std::map<std::string, std::string> found;
  for (Statement rows(database, sql); rows.step();) found.emplace(rows.text(0), rows.text(1));
  return found;
}

namespace fs = std::filesystem;

bool is_recording(const fs::path& file) { return file.extension() == ".cap" || file.extension() == ".mcap"; }

}  // namespace

void make_catalogue(Database& database, const std::string& name) {
  const int format = format_of(database);
  if (format != 0 && format != kCatalogueFormat) fail_of_format(name);
  database.execute(catalogue_tables());
  database.execute(fmt::format("PRAGMA user_version={}", kCatalogueFormat));
}

void read_catalogue(Database& database, const std::string& name, Plan& plan) {
  if (format_of(database) != kCatalogueFormat) fail_of_format(name);
  for (RecordingFile& file : read_files(database)) {
    std::string recording = file.recording;
    plan.recordings.try_emplace(std::move(recording), std::move(file));
  }
  plan.vehicles = texts(database, "SELECT vehicle, toml FROM vehicles");
  plan.configurations = texts(database, "SELECT configuration, toml FROM configurations");
  for (Statement rows(database, "SELECT vehicle, recording FROM nominals ORDER BY recording"); rows.step();)
    plan.nominals[rows.text(0)].push_back(rows.text(1));
  plan.tasks = read_tasks(database);
  // A bank outlives the recording that it was to be made of only where it was made; jobs know that by its result.
  std::set<std::string> used;
  for (const Task& task : plan.tasks) {
    if (!task.makes_bank() && plan.recordings.contains(task.recording)) used.insert(task.bank);
  }
  std::erase_if(plan.tasks, [&](const Task& task) {
    return task.makes_bank() ? !used.contains(task.bank) : !plan.recordings.contains(task.recording);
  });
}

std::vector<RecordingFile> read_files(Database& database) {
  std::vector<RecordingFile> files;
  for (Statement rows(database, "SELECT path, bytes, modified_ns, recording FROM files ORDER BY path");
       rows.step();) {
    files.push_back({rows.text(0), rows.integer(1), rows.integer(2), rows.text(3)});
  }
  return files;
}

std::vector<PlannedBank> read_banks(Database& database) {
  std::vector<PlannedBank> banks;
  for (Statement rows(database,
                      "SELECT bank, recording, vehicle, configuration, missions, seed, outline FROM banks");
       rows.step();) {
    banks.push_back({rows.text(0), rows.text(1), rows.text(2), rows.text(3), static_cast<int>(rows.integer(4)),
                     static_cast<std::uint64_t>(rows.integer(5)), outline_from(rows.text(6))});
  }
  return banks;
}

std::vector<Task> read_tasks(Database& database) {
  std::vector<Task> tasks;
  for (Statement rows(database,
                      "SELECT task, job, recording, vehicle, configuration, bank, missions, seed, key FROM tasks "
                      "ORDER BY task");
       rows.step();) {
    tasks.push_back({static_cast<int>(rows.integer(0)), rows.text(1), rows.text(2), rows.text(3), rows.text(4),
                     rows.text(5), static_cast<int>(rows.integer(6)), static_cast<std::uint64_t>(rows.integer(7)),
                     rows.text(8)});
  }
  return tasks;
}

void write_files(Database& database, const std::vector<RecordingFile>& files) {
  database.execute("DELETE FROM files");
  Statement insert(database, "INSERT INTO files VALUES(?1, ?2, ?3, ?4)");
  for (const RecordingFile& file : files) insert.run(file.path, file.bytes, file.modified_ns, file.recording);
}

void add_bank(Database& database, const PlannedBank& bank) {
  Statement(database, "INSERT INTO banks VALUES(?1, ?2, ?3, ?4, ?5, ?6, ?7)")
      .run(bank.bank, bank.recording, bank.vehicle, bank.configuration, bank.missions, bank.seed,
           outline_text(bank.outline));
}

void add_task(Database& database, const Task& task) {
  Statement(database, "INSERT INTO tasks VALUES(?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9)")
      .run(task.number, task.job, task.recording, task.vehicle, task.configuration, task.bank, task.bank_missions,
           task.bank_seed, task.key);
}

fs::path FolderScan::vehicle_of(const fs::path& file) const {
  for (fs::path folder = file.parent_path(); folder.has_relative_path(); folder = folder.parent_path()) {
    if (const auto found = vehicles.find(folder); found != vehicles.end()) return found->second;
  }
  return {};
}

bool look_at(RecordingFile& file) {
  struct stat status {};
  if (::stat(file.path.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return false;
  constexpr std::int64_t kNanoseconds = 1'000'000'000;
  file.bytes = status.st_size;
  file.modified_ns = status.st_mtim.tv_sec * kNanoseconds + status.st_mtim.tv_nsec;
  return true;
}

FolderScan scan(const fs::path& folder) {
  FolderScan found;
  std::error_code error;
  const fs::path whole = fs::canonical(folder, error);
  fs::recursive_directory_iterator at(whole, error);
  for (const fs::recursive_directory_iterator end; !error && at != end; at.increment(error)) {
    const fs::path& path = at->path();
    std::error_code unreadable;
    if (path.filename().string().starts_with('.') || fs::exists(catalogue_of(path), unreadable)) {
      at.disable_recursion_pending();
      continue;
    }
    if (path.filename() == "vehicle.toml") found.vehicles[path.parent_path()] = path;
    RecordingFile file{path.string(), 0, 0, {}};
    if (is_recording(path) && look_at(file)) found.files.push_back(std::move(file));
  }
  if (error) throw base::Failure(base::Exit::bad_input, folder.string() + ": " + error.message());
  std::sort(found.files.begin(), found.files.end(), [](const auto& a, const auto& b) { return a.path < b.path; });
  return found;
}

}  // namespace navcal::fleet
