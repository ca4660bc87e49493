// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>

#include "analysis/device_check.h"
#include "base/gravity.h"

namespace navcal::analysis {
namespace {

using protocols::described::Description;
using protocols::described::Field;
using protocols::described::FrameKind;
using protocols::described::Meaning;

/// So many frames at least before a field that never changes is worth a word.
constexpr std::uint64_t kEnoughFrames = 20;
/// Share of bytes or frames that is not an accident.
constexpr double kNotable = 0.02;
/// Relative difference of rates beyond which one of them is wrong.
constexpr double kOffRate = 0.05;
/// Specific force beside gravity, and field beside the Earth's: wider than any vehicle at sea.
constexpr double kForceTolerance = 0.3, kStrongestField_uT = 90;

class Warnings {
 public:
  Warnings(const Description& description, const DeviceFindings& findings)
      : description_(description), findings_(findings) {}

  std::vector<std::string> all() {
    about_stream();
    for (std::size_t i = 0; i < findings_.kinds.size(); ++i) about_kind(description_.kinds[i], findings_.kinds[i]);
    return std::move(words_);
  }

 private:
  template <class... Values>
  void warn(fmt::format_string<Values...> format, Values&&... values) {
    words_.push_back(fmt::format(format, std::forward<Values>(values)...));
  }

  void about_stream() {
    const auto& counters = findings_.summary.counters;
    if (counters.bytes == 0) return warn("the capture is empty");
    const double skipped =
        static_cast<double>(findings_.summary.skipped_bytes()) / static_cast<double>(counters.bytes);
    if (skipped > kNotable)
      warn(
          "{:.0f} % of the bytes are in no frame: the description does not know all that the device sends, or the "
          "line speed was wrong",
          100 * skipped);
    if (static_cast<double>(counters.bad_checksum) > kNotable * static_cast<double>(counters.frames))
      warn(
          "{} candidates had a bad checksum for {} good frames: kind, place or covered bytes of the checksum may "
          "be wrong",
          counters.bad_checksum, counters.frames);
  }

  void about_kind(const FrameKind& kind, const KindFinding& found) {
    const std::string id(kind.id.view());
    if (found.frames == 0) return warn("{}: no frame of this kind was found", id);
    if (kind.checksum.sum == protocols::described::Sum::none)
      warn("{}: without a checksum a damaged frame looks like a good one", id);
    if (found.impossible > 0)
      warn("{}: {} of {} frames have a value that cannot be; they give no samples", id, found.impossible,
           found.frames);
    if (description_.rate_Hz && *description_.rate_Hz > 0 && found.rate_Hz && found.frames >= kEnoughFrames &&
        std::abs(*found.rate_Hz / *description_.rate_Hz - 1) > kOffRate && description_.kinds.size() == 1)
      warn("{}: {:.3g} frames a second came, and rate_Hz is {:g}", id, *found.rate_Hz, *description_.rate_Hz);
    for (std::size_t i = 0; i < found.fields.size(); ++i)
      about_field(id, kind.fields[i], found.fields[i], found.frames);
    about_vectors(id, kind, found);
  }

  void about_field(const std::string& id, const Field& field, const FieldFinding& found, std::uint64_t frames) {
    const bool is_flag = field.meaning >= Meaning::leak_forward || field.bits > 0;
    if (found.values == 0) return warn("{}: {} never has a value", id, found.name);
    if (found.impossible > 0)
      warn("{}: {} of {} values of {} are beyond {}", id, found.impossible, found.values, found.name,
           bounds_of(field));
    if (found.changes == 0 && frames >= kEnoughFrames && !is_flag)
      warn("{}: {} never changes from {:g}", id, found.name, found.low);
    if (field.meaning == Meaning::sequence && found.changes > 0 && found.changes + 1 < found.values)
      warn("{}: {} repeats in {} of {} frames", id, found.name, found.values - 1 - found.changes, found.values);
  }

  static std::string bounds_of(const Field& field) {
    const auto& meaning = info_of(field.meaning);
    const double low = field.low.value_or((meaning.low - field.offset) / field.factor);
    const double high = field.high.value_or((meaning.high - field.offset) / field.factor);
    return fmt::format("{:g} to {:g}{}{}", low, high, field.unit.empty() ? "" : " ", field.unit);
  }

  /// Mean of a field in the unit of samples.
  static std::optional<double> mean_of(const FrameKind& kind, const KindFinding& found, Meaning meaning) {
    for (std::size_t i = 0; i < kind.fields.size(); ++i) {
      const Field& field = kind.fields[i];
      if (field.meaning == meaning && found.fields[i].values > 0)
        return found.fields[i].mean * field.factor + field.offset;
    }
    return std::nullopt;
  }

  void about_vectors(const std::string& id, const FrameKind& kind, const KindFinding& found) {
    const auto x = mean_of(kind, found, Meaning::specific_force_x),
               y = mean_of(kind, found, Meaning::specific_force_y),
               z = mean_of(kind, found, Meaning::specific_force_z);
    if (x && y && z) {
      const double size = std::sqrt(*x * *x + *y * *y + *z * *z);
      if (std::abs(size / base::kGravity_m_s2 - 1) > kForceTolerance)
        warn("{}: the mean specific force is {:.2f} m/s2 long; gravity is {:g}. Unit or scale may be wrong", id,
             size, base::kGravity_m_s2);
      else if (*z > 0.5 * size)
        warn("{}: specific_force.z is {:+.2f} m/s2 on average; of a level unit with z down it is -{:g}", id, *z,
             base::kGravity_m_s2);
    }
    const auto north = mean_of(kind, found, Meaning::field_x), east = mean_of(kind, found, Meaning::field_y),
               down = mean_of(kind, found, Meaning::field_z);
    if (north && east && down) {
      const double size = std::sqrt(*north * *north + *east * *east + *down * *down);
      if (size > kStrongestField_uT)
        warn("{}: the mean field is {:.1f} uT long; the Earth's is 25 to 65. Unit or scale may be wrong", id,
             size);
    }
  }

  const Description& description_;
  const DeviceFindings& findings_;
  std::vector<std::string> words_;
};

}  // namespace

std::vector<std::string> warnings_about(const Description& description, const DeviceFindings& findings) {
  return Warnings(description, findings).all();
}

}  // namespace navcal::analysis
