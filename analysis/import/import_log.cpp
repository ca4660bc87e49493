// SPDX-License-Identifier: Apache-2.0
#include "analysis/import/import_log.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "analysis/import/mapped_file.h"
#include "analysis/import/port_name.h"
#include "analysis/log_builder.h"
#include "config/load.h"

namespace navcal::analysis {
namespace {

using protocols::samples_line::LineWriter;

constexpr std::size_t kHead_bytes = 4096;

/// Other systems log a sample within about this time, and do not say how uncertain it is.
constexpr double kLogged_std_s = 0.001;

/// Refuses times that are far from all others: a damaged record has any time.
class TimeGate {
 public:
  [[nodiscard]] bool lets_in(std::int64_t time_ns) {
    const bool is_near = !newest_ns_ || std::abs(time_ns - *newest_ns_) <= kFarthest_ns;
    const bool is_confirmed = far_ns_ && std::abs(time_ns - *far_ns_) <= kFarthest_ns;
    if (!is_near && !is_confirmed) {
      far_ns_ = time_ns;
      return false;
    }
    newest_ns_ = time_ns;
    far_ns_.reset();
    return true;
  }

 private:
  static constexpr std::int64_t kFarthest_ns = 600'000'000'000;
  std::optional<std::int64_t> newest_ns_;
  std::optional<std::int64_t>
      far_ns_;  ///< the last one that was refused; a second one near it is a gap of the log
};

/// The part that both passes share, so that they let in the same samples.
class ImportPass : public ImportSink {
 public:
  ImportPass(const record::Progress& progress, double from, double to, std::size_t size)
      : progress_(progress), from_(from),
        share_((to - from) / static_cast<double>(std::max<std::size_t>(size, 1))) {}

  void sample(const ImportedSample& sample, LineWriter& line) final {
    if (gate_.lets_in(sample.time_ns)) {
      take(sample, line);
    } else {
      left(fmt::format("{} (far from all other times)", sample.message));
    }
  }
  // A compressed file has more bytes than its size.
  void progress(std::uint64_t done) final { progress_(std::min(from_ + share_ * static_cast<double>(done), 1.0)); }

 protected:
  virtual void take(const ImportedSample& sample, LineWriter& line) = 0;

 private:
  TimeGate gate_;
  const record::Progress& progress_;
  double from_, share_;
};

class Survey final : public ImportPass {
 public:
  Survey(const record::Progress& progress, std::size_t size) : ImportPass(progress, 0, 0.3, size) {}

  void left(std::string_view message) override {
    const auto found = left_.find(message);
    if (found == left_.end()) {
      left_.emplace(message, 1);
    } else {
      ++found->second;
    }
  }
  void utc(std::int64_t time_ns, std::int64_t utc_ns) override {
    const std::int64_t offset_ns = utc_ns - time_ns;
    if (!offset_ns_ || offset_ns > *offset_ns_) offset_ns_ = offset_ns;
  }

  void finish(ImportReport& report) {
    report.taken = std::move(taken_);
    report.left = std::move(left_);
    report.duration_ns = newest_ns_ - first_ns_;
  }
  [[nodiscard]] std::vector<std::string> ports() const {
    std::vector<std::string> names;
    for (const auto& [of, taken] : taken_) {
      if (std::find(names.begin(), names.end(), of.second) == names.end()) names.push_back(of.second);
    }
    std::ranges::stable_sort(names, [](const auto& a, const auto& b) { return port_rank(a) < port_rank(b); });
    return names;
  }
  [[nodiscard]] std::optional<std::int64_t> offset_ns() const { return offset_ns_; }
  [[nodiscard]] std::int64_t first_ns() const { return first_ns_; }

 private:
  void take(const ImportedSample& sample, LineWriter& /*line*/) override {
    ImportReport::Taken& taken = taken_[{std::string(sample.message), std::string(sample.port)}];
    if (taken.samples++ == 0) taken.first_ns = taken.last_ns = sample.time_ns;
    if (!sample.continues) ++taken.messages;
    taken.first_ns = std::min(taken.first_ns, sample.time_ns);
    taken.last_ns = std::max(taken.last_ns, sample.time_ns);
    first_ns_ = any_ ? std::min(first_ns_, sample.time_ns) : sample.time_ns;
    newest_ns_ = any_ ? std::max(newest_ns_, sample.time_ns) : sample.time_ns;
    any_ = true;
  }

  std::map<ImportReport::Source, ImportReport::Taken> taken_;
  std::map<std::string, std::uint64_t, std::less<>> left_;
  std::optional<std::int64_t> offset_ns_;
  bool any_ = false;
  std::int64_t first_ns_ = 0, newest_ns_ = 0;
};

class Writing final : public ImportPass {
 public:
  Writing(LogBuilder& log, const config::Settings& settings, std::int64_t begin_ns, std::int64_t offset_ns,
          const record::Progress& progress, std::size_t size)
      : ImportPass(progress, 0.3, 1, size), log_(log), newest_ns_(begin_ns), offset_ns_(offset_ns) {
    for (const auto& port : settings.ports) ports_.emplace(port.name, static_cast<std::uint16_t>(ports_.size()));
  }
  void left(std::string_view /*message*/) override {}
  void utc(std::int64_t /*time_ns*/, std::int64_t /*utc_ns*/) override {}

 private:
  void take(const ImportedSample& sample, LineWriter& line) override {
    const auto port = ports_.find(sample.port);
    if (port == ports_.end()) throw record::BadRecording("the file has changed while it was read");
    line.seconds("time", sample.utc_ns.value_or(sample.time_ns + offset_ns_));
    const std::string text = line.finish();
    newest_ns_ = std::max(newest_ns_, sample.time_ns);
    read_.port = port->second;
    read_.time_ns = newest_ns_;
    read_.bytes.assign(text.begin(), text.end());
    log_.take(read_);
  }

  LogBuilder& log_;
  std::map<std::string, std::uint16_t, std::less<>> ports_;
  std::int64_t newest_ns_;
  std::int64_t offset_ns_;
  record::RawRead read_;
};

/// First bytes of files that are none of the formats, and the conversion that helps.
constexpr std::array<std::pair<std::string_view, std::string_view>, 2> kRemedies{
    {{"#ROSBAG V",
      "a ROS 1 bag: \"rosbags-convert --dst-storage mcap --src FILE --dst FOLDER\" makes an .mcap of it"},
     {"SQLite format 3",
      "an SQLite database: of a ROS 2 bag, \"ros2 bag convert\" with storage_id: mcap makes an .mcap"}}};

/// A table without a map: to be refused with words about the map.
bool has_name_of_csv(const std::filesystem::path& input) {
  return input.extension() == ".csv" || input.extension() == ".CSV";
}

const ImportFormat& format_of(const std::filesystem::path& input, std::string_view bytes,
                              const ImportOptions& options) {
  const ImportFormat* format = options.format.empty() ? import_format_of(bytes.substr(0, kHead_bytes))
                                                      : import_format_named(options.format);
  if (format == nullptr && options.format.empty() && (!options.map.empty() || has_name_of_csv(input)))
    format = import_format_named(kCsvFormat);
  if (format != nullptr) return *format;
  throw record::BadRecording(
      fmt::format("{}: byte 0: none of the formats {}", input.string(), import_format_names()));
}

config::Settings settings_for(const std::filesystem::path& input, const std::vector<std::string>& ports) {
  config::Settings settings;
  for (const std::string& name : ports) {
    auto port = config::default_port(name, protocols::Protocol::samples,
                                     config::default_baud(protocols::Protocol::samples));
    port.path = std::filesystem::absolute(input).string() + ":" + name;
    port.latency_std_s = kLogged_std_s;
    settings.ports.push_back(std::move(port));
  }
  return settings;
}

pipeline::UtcMapping mapping_of(const ImportFindings& findings, const Survey& survey, ImportReport& report) {
  pipeline::UtcMapping mapping;
  mapping.source = pipeline::UtcMapping::Source::file;
  mapping.at_ns = survey.first_ns();
  mapping.bound_ns = 0;
  if (findings.times_are_utc) {
    report.utc = ImportReport::Utc::of_file;
  } else if (survey.offset_ns()) {
    report.utc = ImportReport::Utc::of_gps;
    mapping.offset_ns = *survey.offset_ns();
    mapping.bound_ns = kGpsBound_ns;
  } else {
    mapping.offset_ns = kStatedDate_ns;
    mapping.bound_ns = pipeline::UtcMapping::kUnknownBound;
  }
  report.start_utc_ns = mapping.to_utc(survey.first_ns());
  return mapping;
}

}  // namespace

bool is_foreign_log(const std::filesystem::path& input, const ImportOptions& options) {
  if (!options.format.empty() || !options.map.empty() || has_name_of_csv(input)) return true;
  if (std::filesystem::is_directory(input))
    throw record::BadRecording(input.string() + ": a folder; of a ROS 2 bag, name the .mcap file in it");
  const MappedFile file(input);
  const std::string_view head = file.bytes().substr(0, kHead_bytes);
  for (const auto& [begin, remedy] : kRemedies) {
    if (head.starts_with(begin)) throw record::BadRecording(fmt::format("{}: {}", input.string(), remedy));
  }
  return import_format_of(head) != nullptr;
}

ImportReport import_log(const std::filesystem::path& input, const std::filesystem::path& log,
                        const ImportOptions& options, const record::Progress& progress) {
  const MappedFile file(input);
  const ImportFormat& format = format_of(input, file.bytes(), options);
  ImportReport report;
  report.input = input.string();
  report.output = log.string();
  report.format = format.name;
  report.bytes = file.bytes().size();
  Survey survey(progress, file.bytes().size());
  // A reader of a format knows bytes and no file.
  ImportOptions with_folder = options;
  with_folder.folders.push_back(std::filesystem::absolute(input).parent_path());
  const auto read = [&](ImportSink& sink) {
    std::string problem;
    try {
      ImportFindings findings = format.read(file.bytes(), with_folder, sink);
      if (file.is_whole()) return findings;
    } catch (const record::BadRecording& error) {
      problem = error.what();
    }
    if (!file.is_whole()) problem = "it was cut, or could not be read any more, during the import";
    throw record::BadRecording(fmt::format("{}: {}", report.input, problem));
  };
  ImportFindings findings = read(survey);
  const auto ports = survey.ports();
  if (ports.empty())
    throw record::BadRecording(fmt::format("{}: a {} without any message that can be taken{}{}", report.input,
                                           format.description, findings.remarks.empty() ? "" : "; ",
                                           fmt::join(findings.remarks, "; ")));
  const pipeline::UtcMapping mapping = mapping_of(findings, survey, report);
  const config::Settings settings = settings_for(input, ports);
  LogBuilder builder(settings, log);
  builder.begin({survey.first_ns(), mapping});
  builder.tell("info", "import",
               fmt::format("of {} ({}); UTC: {}{}{}", report.input, format.name,
                           report.utc == ImportReport::Utc::unknown  ? "not known, times count from 2000-01-01"
                           : report.utc == ImportReport::Utc::of_gps ? "by GPS"
                                                                     : "of the file",
                           findings.has_corrected_fields ? "; " : "",
                           findings.has_corrected_fields ? kCorrectedFields : ""));
  Writing writing(builder, settings, survey.first_ns(), mapping.offset_ns, progress, file.bytes().size());
  (void)read(writing);
  survey.finish(report);
  std::map<std::string, std::uint64_t> refused;
  for (const auto& [of, taken] : report.taken) refused[of.second] += taken.samples;
  report.cut_at = findings.cut_at;
  report.damaged_bytes = findings.damaged_bytes;
  report.remarks = std::move(findings.remarks);
  for (std::size_t i = 0; i < ports.size(); ++i) {
    const auto statistics = builder.pipeline().statistics(static_cast<std::uint16_t>(i));
    const auto lost = refused[ports[i]] -= statistics.samples;
    if (lost > 0) report.left[fmt::format("sample of {} (no value, or one out of range)", ports[i])] = lost;
    report.refused += lost;
    if (statistics.unused.total() > 0)
      report.remarks.push_back(
          fmt::format("{}: frames without a sample: {}", ports[i], statistics.unused.words()));
  }
  builder.commit();
  return report;
}

}  // namespace navcal::analysis
