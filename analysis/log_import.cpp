// SPDX-License-Identifier: Apache-2.0
#include "analysis/log_import.h"

#include "analysis/log_builder.h"
#include "record/recording.h"

namespace navcal::analysis {
namespace {

/// A capture says what its ports are called and speak, not where they were; a configuration must.
config::Settings with_places(config::Settings settings, const std::filesystem::path& capture) {
  for (auto& port : settings.ports) {
    if (port.path.empty()) port.path = std::filesystem::absolute(capture).string() + ":" + port.name;
  }
  return settings;
}

}  // namespace

std::vector<std::string> import_capture(const std::filesystem::path& capture, const std::filesystem::path& log,
                                        const record::Progress& progress) {
  if (record::is_log(capture)) throw record::BadRecording(capture.string() + ": it is a log already");
  const auto recording = record::Recording::open(capture);
  LogBuilder builder(with_places(recording->settings(), capture), log);
  while (const auto entry = recording->next()) {
    if (const auto* first = std::get_if<record::MappingChange>(&*entry)) builder.begin(*first);
    if (const auto* read = std::get_if<record::RawRead>(&*entry)) builder.take(*read);
    if (const auto* event = std::get_if<record::LoggedEvent>(&*entry)) builder.take(*event);
    progress(recording->progress());
  }
  builder.commit();
  return recording->remarks();
}

}  // namespace navcal::analysis
