// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <strings.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "analysis/import/decompress.h"
#include "analysis/import/log_readers.h"
#include "analysis/import/mapped_file.h"
#include "analysis/import/port_name.h"
#include "base/angles.h"
#include "record/recording.h"

namespace navcal::analysis {
namespace {

using protocols::samples_line::LineWriter;

constexpr std::string_view kSlocumLabel = "dbd_label:";
constexpr std::size_t kKnownBytes = 16;
constexpr int kMostSensors = 20'000;

/// A quantity of an actuator, in the unit of layouts of vehicles (docs/identify.md).
struct Actuator {
  std::string_view sensor, quantity, unit;
  double factor;
};
constexpr double kInch_m = 0.0254, kBuoyancy_N_cc = 1e-6 * 1025 * 9.80665;
constexpr std::array kActuators{Actuator{"c_ballast_pumped", "ballast", "N", kBuoyancy_N_cc},
                                Actuator{"c_de_oil_vol", "ballast", "N", kBuoyancy_N_cc},
                                Actuator{"c_battpos", "moving_mass", "m", kInch_m},
                                Actuator{"m_ballast_pumped", "m_ballast_pumped", "N", kBuoyancy_N_cc},
                                Actuator{"m_de_oil_vol", "m_de_oil_vol", "N", kBuoyancy_N_cc},
                                Actuator{"m_battpos", "m_battpos", "m", kInch_m},
                                Actuator{"m_fin", "m_fin", "rad", 1}};
/// Commands of the pump of shallow gliders and of that of deep ones. A glider has one of them; it may name both.
constexpr std::array<std::string_view, 2> kPumps{"c_ballast_pumped", "c_de_oil_vol"};

struct SlocumSensor {
  std::string name, unit;
  std::size_t bytes = 0;
};

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  while (!line.empty()) {
    const std::size_t first = line.find_first_not_of(" \t\r");
    if (first == std::string_view::npos) break;
    line.remove_prefix(first);
    const std::size_t end = std::min(line.find_first_of(" \t\r"), line.size());
    words.push_back(line.substr(0, end));
    line.remove_prefix(end);
  }
  return words;
}

int whole_number(std::string_view text) {
  int value = -1;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

std::string_view next_line(std::string_view text, std::size_t& at) {
  const std::size_t end = std::min(text.find('\n', at), text.size());
  const std::string_view line = text.substr(at, end - at);
  at = std::min(end + 1, text.size());
  return line;
}

/// The list of sensors with this checksum, from a .cac file or a compressed .ccc.
std::string list_of_sensors(std::string_view checksum, std::span<const std::filesystem::path> folders) {
  const std::string plain = fmt::format("{}.cac", checksum), compressed = fmt::format("{}.ccc", checksum);
  for (const auto& folder : folders) {
    std::error_code none;
    for (const auto& entry : std::filesystem::directory_iterator(folder, none)) {
      const std::string found = entry.path().filename().string();
      if (::strcasecmp(found.c_str(), plain.c_str()) == 0) return std::string(MappedFile(entry.path()).bytes());
      if (::strcasecmp(found.c_str(), compressed.c_str()) == 0)
        return decompressed_blocks(MappedFile(entry.path()).bytes());
    }
  }
  throw record::BadRecording(
      fmt::format("its list of sensors is in {}, which is neither beside it nor in the folder of --cache", plain));
}

/// DDMM.MMM, as NMEA writes it, to degrees; nullopt for what is no place (69696969: no fix).
std::optional<double> degrees_of_nmea(double value, double most) {
  const double degrees = std::trunc(value / 100), minutes = value - degrees * 100;
  if (!(std::abs(degrees) <= most) || !(std::abs(minutes) < 60)) return std::nullopt;
  return degrees + minutes / 60;
}

class SlocumFile {
 public:
  SlocumFile(std::string_view file, std::span<const std::filesystem::path> folders, ImportSink& sink)
      : decompressed_(file.starts_with(kSlocumLabel) ? "" : decompressed_blocks(file)),
        file_(decompressed_.empty() ? file : decompressed_), folders_(folders), sink_(sink) {}
  ImportFindings read();

 private:
  bool read_header();
  bool read_sensors();
  bool read_byte_order();
  /// Finds the pump that gets fewer commands, where the file has both.
  void find_idle_pump();
  /// False when the cycle is not whole.
  bool read_cycle();
  [[nodiscard]] double value_at(std::size_t at, std::size_t bytes) const;
  void emit();
  void emit_sensors(std::int64_t time_ns);
  void emit_line(std::int64_t time_ns, std::string_view message, PortKind port, LineWriter& line, bool has_any);
  std::optional<double> take(std::string_view name);
  [[nodiscard]] std::string_view header(std::string_view key) const {
    const auto found = header_.find(key);
    return found == header_.end() ? std::string_view{} : found->second;
  }

  std::string decompressed_;  ///< empty: the file is not compressed
  std::string_view file_;
  std::span<const std::filesystem::path> folders_;
  ImportSink& sink_;
  ImportFindings findings_;
  std::size_t at_ = 0;
  std::map<std::string_view, std::string_view> header_;
  std::vector<SlocumSensor> sensors_;  ///< in the order of a cycle
  std::size_t state_bytes_ = 0;
  bool is_swapped_ = false;
  std::string_view idle_pump_;
  std::map<std::string_view, double> fresh_;  ///< new in this cycle, and not yet taken
  std::optional<std::int64_t> time_ns_;
};

bool SlocumFile::read_header() {
  constexpr int kMostTags = 100;
  int tags = kMostTags;
  for (int i = 0; i < tags && at_ < file_.size(); ++i) {
    const std::string_view line = next_line(file_, at_);
    const std::size_t colon = line.find(':');
    if (colon == std::string_view::npos) return false;
    const auto words = words_of(line.substr(colon + 1));
    header_[line.substr(0, colon)] = words.empty() ? std::string_view{} : words.front();
    if (line.starts_with("num_ascii_tags:"))
      tags = std::clamp(whole_number(header("num_ascii_tags")), 0, kMostTags);
  }
  return header("sensor_list_factored") == "0" || header("sensor_list_factored") == "1";
}

bool SlocumFile::read_sensors() {
  const int in_cycle = whole_number(header("sensors_per_cycle"));
  const int states = whole_number(header("state_bytes_per_cycle"));
  const int total = whole_number(header("total_num_sensors"));
  if (in_cycle <= 0 || in_cycle > kMostSensors || states != (in_cycle + 3) / 4 || total > kMostSensors)
    return false;
  state_bytes_ = static_cast<std::size_t>(states);
  const bool is_factored = header("sensor_list_factored") == "1";
  const std::string list = is_factored ? list_of_sensors(header("sensor_list_crc"), folders_) : "";
  std::size_t at_of_list = 0;
  sensors_.resize(static_cast<std::size_t>(in_cycle));
  for (int i = 0; i < total; ++i) {
    // "s: T 12 3 4 m_depth m": used, number, place in a cycle, bytes, name, unit.
    const auto words = words_of(is_factored ? next_line(list, at_of_list) : next_line(file_, at_));
    if (words.size() < 6 || words[0] != "s:" || words[5].size() > kLongestName) return false;
    const int place = whole_number(words[3]), bytes = whole_number(words[4]);
    if (words[1] != "T") continue;
    if (place < 0 || place >= in_cycle || (bytes != 1 && bytes != 2 && bytes != 4 && bytes != 8)) return false;
    sensors_[static_cast<std::size_t>(place)] = {
        std::string(words[5]), words.size() > 6 ? std::string(words[6]) : "", static_cast<std::size_t>(bytes)};
  }
  return std::ranges::none_of(sensors_, [](const SlocumSensor& sensor) { return sensor.bytes == 0; });
}

/// The cycle of known bytes: 's', 'a', 0x1234, 123.456 as float, 123456789.12345 as double.
bool SlocumFile::read_byte_order() {
  if (file_.size() - at_ < kKnownBytes || file_.substr(at_, 2) != "sa") return false;
  is_swapped_ = file_[at_ + 2] == '\x12';
  at_ += kKnownBytes;
  return true;
}

void SlocumFile::find_idle_pump() {
  const std::size_t first = at_;
  std::array<int, kPumps.size()> commands{};
  while (at_ < file_.size() && file_[at_] == 'd' && read_cycle()) {
    for (std::size_t i = 0; i < kPumps.size(); ++i) commands[i] += fresh_.contains(kPumps[i]) ? 1 : 0;
  }
  at_ = first;
  if (*std::ranges::min_element(commands) == 0) return;
  const std::size_t used = commands[1] > commands[0] ? 1 : 0;
  idle_pump_ = kPumps[1 - used];
  findings_.remarks.push_back(
      fmt::format("the ballast is {} ({} commands); {} ({}) is that of another pump, and left", kPumps[used],
                  commands[used], idle_pump_, commands[1 - used]));
}

double SlocumFile::value_at(std::size_t at, std::size_t bytes) const {
  std::array<char, 8> raw{};
  std::copy_n(file_.data() + at, bytes, raw.begin());
  if (is_swapped_) std::reverse(raw.begin(), raw.begin() + static_cast<std::ptrdiff_t>(bytes));
  const auto as = [&]<class T>(T) {
    std::array<char, sizeof(T)> part{};
    std::copy_n(raw.begin(), sizeof(T), part.begin());
    return static_cast<double>(std::bit_cast<T>(part));
  };
  if (bytes == 8) return as(double{});
  if (bytes == 4) return as(float{});
  return bytes == 2 ? as(std::int16_t{}) : as(std::int8_t{});
}

bool SlocumFile::read_cycle() {
  constexpr unsigned kNew = 2;
  std::size_t at = at_ + 1 + state_bytes_;
  if (at > file_.size()) return false;
  fresh_.clear();
  for (std::size_t i = 0; i < sensors_.size(); ++i) {
    const auto states = static_cast<unsigned char>(file_[at_ + 1 + i / 4]);
    if ((states >> (6 - 2 * (i % 4)) & 3U) != kNew) continue;
    if (file_.size() - at < sensors_[i].bytes) return false;
    fresh_[sensors_[i].name] = value_at(at, sensors_[i].bytes);
    at += sensors_[i].bytes;
  }
  at_ = at;
  return true;
}

std::optional<double> SlocumFile::take(std::string_view name) {
  const auto found = fresh_.find(name);
  if (found == fresh_.end()) return std::nullopt;
  const double value = found->second;
  fresh_.erase(found);
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

void SlocumFile::emit_line(std::int64_t time_ns, std::string_view message, PortKind port, LineWriter& line,
                           bool has_any) {
  if (has_any) sink_.sample({message, port_name(port, 0), time_ns}, line);
}

void SlocumFile::emit() {
  constexpr double kLast_s = 4'102'444'800;  // 2100
  const auto own_s = take("m_present_time"), science_s = take("sci_m_present_time");
  if (const auto now_s = own_s ? own_s : science_s; now_s && *now_s > 0 && *now_s < kLast_s)
    time_ns_ = std::llround(*now_s * 1e9);
  if (!time_ns_) return sink_.left("cycle without a time");
  LineWriter attitude("COMPASS");
  const auto heading_rad = take("m_heading"), pitch_rad = take("m_pitch"), roll_rad = take("m_roll");
  if (heading_rad) attitude.number("heading_rad", base::as_heading(*heading_rad));
  attitude.number("pitch_rad", pitch_rad).number("roll_rad", roll_rad);
  emit_line(*time_ns_, "m_heading, m_pitch, m_roll", PortKind::compass, attitude,
            heading_rad || pitch_rad || roll_rad);
  if (const auto depth_m = take("m_depth")) {
    LineWriter line("DEPTH");
    emit_line(*time_ns_, "m_depth", PortKind::depth, line.number("depth_m", *depth_m), true);
  }
  const auto lat = take("m_gps_lat"), lon = take("m_gps_lon");
  if (lat && lon) {
    const auto lat_deg = degrees_of_nmea(*lat, 90), lon_deg = degrees_of_nmea(*lon, 180);
    LineWriter line("GPS");
    line.text("fix", lat_deg && lon_deg ? "2d" : "none");
    if (lat_deg && lon_deg) line.number("lat", *lat_deg).number("lon", *lon_deg);
    emit_line(*time_ns_, "m_gps_lat, m_gps_lon", PortKind::gps, line, true);
  }
  if (const auto altitude_m = take("m_altitude"); altitude_m && *altitude_m >= 0) {
    LineWriter line("ALTIMETER");
    emit_line(*time_ns_, "m_altitude", PortKind::altimeter, line.number("altitude_m", *altitude_m), true);
  }
  if (const auto voltage_V = take("m_battery")) {
    LineWriter line("POWER");
    emit_line(*time_ns_, "m_battery", PortKind::battery, line.number("voltage_V", *voltage_V), true);
  }
  emit_sensors(*time_ns_);
}

/// The science computer's values are mission sensors, those of actuators too; what else is left is the glider's
/// own.
void SlocumFile::emit_sensors(std::int64_t time_ns) {
  for (const SlocumSensor& sensor : sensors_) {
    const auto found = fresh_.find(sensor.name);
    if (found == fresh_.end()) continue;
    const bool is_science = sensor.name.starts_with("sci_"), is_fin = sensor.name == "c_fin";
    Actuator as{sensor.name, std::string_view(sensor.name).substr(is_science ? 4 : 0), sensor.unit, 1};
    const auto* const actuator = std::ranges::find(kActuators, sensor.name, &Actuator::sensor);
    if (actuator != kActuators.end()) as = *actuator;
    if ((!is_science && !is_fin && actuator == kActuators.end()) || !std::isfinite(found->second) ||
        sensor.name == idle_pump_) {
      sink_.left(sensor.name);
      continue;
    }
    LineWriter line(is_fin ? "MOTOR" : "SENSOR");
    if (is_fin) line.three("fins_rad", {found->second});
    if (!is_fin)
      line.text("quantity", as.quantity).text("unit", as.unit).number("value", found->second * as.factor);
    sink_.sample({sensor.name, port_name(is_science ? PortKind::sensors : PortKind::motor, 0), time_ns}, line);
  }
}

ImportFindings SlocumFile::read() {
  constexpr std::size_t kProgressBytes = 1 << 16;
  findings_.times_are_utc = true;
  if (!read_header() || !read_sensors() || !read_byte_order()) {
    findings_.cut_at = at_;
    return std::move(findings_);
  }
  find_idle_pump();
  std::size_t told = 0;
  while (at_ < file_.size() && file_[at_] != 'X') {
    if (file_[at_] != 'd') {
      // The next cycle cannot be found: values may hold any byte.
      findings_.damaged_bytes = file_.size() - at_;
      return std::move(findings_);
    }
    if (!read_cycle()) {
      findings_.cut_at = at_;
      return std::move(findings_);
    }
    emit();
    if (at_ - told >= kProgressBytes) sink_.progress(told = at_);
  }
  if (at_ >= file_.size()) findings_.cut_at = at_;
  return std::move(findings_);
}

}  // namespace

// In a compressed file, the label stands behind the length of its block and of its first literals.
bool is_slocum(std::string_view head) {
  constexpr std::size_t kFewest = 3, kMost = 6;
  const std::size_t at = head.find(kSlocumLabel);
  return at == 0 || (at >= kFewest && at <= kMost);
}

ImportFindings read_slocum(std::string_view file, std::span<const std::filesystem::path> folders,
                           ImportSink& sink) {
  return SlocumFile(file, folders, sink).read();
}

}  // namespace navcal::analysis
