// SPDX-License-Identifier: Apache-2.0
#include "fleet/merge.h"

#include "analysis/failure.h"
#include "fleet/database.h"
#include "fleet/merge_tables.h"
#include "fleet/result_store.h"
#include "fleet/whole_writing.h"

namespace navcal::fleet {
namespace {

namespace fs = std::filesystem;

MergeSummary fill(const Plan& plan, Database& database) {
  MergeTables tables(database);
  for (const auto& [hash, file] : plan.recordings) tables.add_recording(file);
  for (const auto& [hash, toml] : plan.vehicles) tables.add_vehicle(hash, toml);
  const ResultStore results(plan.folder);
  const ResultStore::States states = results.states();
  MergeSummary summary;
  for (const Task& task : plan.tasks) {
    TaskState state = state_in(states, task);
    const std::string text = results.text_of(task, state).value_or("");
    if (text.empty()) state = TaskState::open;
    tables.add_task(task, state, text);
    (state == TaskState::done ? summary.done : state == TaskState::failed ? summary.failed : summary.open) += 1;
  }
  return summary;
}

}  // namespace

MergeSummary merge(const Plan& plan, const fs::path& file) {
  const fs::path part = part_of(file);
  try {
    fs::remove(part);
    MergeSummary summary;
    {
      Database database(part, Database::Access::create);
      make_merge_tables(database);
      database.execute("BEGIN");
      summary = fill(plan, database);
      database.execute("COMMIT");
    }
    rename_whole(part, file);
    return summary;
  } catch (const DatabaseError& error) {
    fs::remove(part);
    throw analysis::Failure(analysis::Exit::failed, error.what());
  } catch (...) {
    fs::remove(part);
    throw;
  }
}

}  // namespace navcal::fleet
