// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <optional>

#include "instruments/compass_calibration.h"
#include "protocols/trax.h"

namespace navcal::instruments {
namespace {

namespace trax = protocols::trax;
using trax::FrameNumber;

constexpr std::uint32_t kPoints = 12;
constexpr std::int64_t kPniReply_ns = 500 * base::kMillisecond_ns;
/// kSave writes flash memory; a score needs some arithmetic.
constexpr std::int64_t kPniSaves_ns = 2 * base::kSecond_ns;
constexpr std::int64_t kPniSettles_ns = 100 * base::kMillisecond_ns;
constexpr int kPniRepeats = 3;

bool is_frame(const protocols::Frame& frame, FrameNumber number) {
  return frame.bytes.size() >= trax::kOverhead && frame.bytes[2] == static_cast<std::uint8_t>(number);
}
bool is_done(const protocols::Frame& frame) { return is_frame(frame, FrameNumber::set_config_done); }
bool is_measurement(const protocols::Frame& frame) { return is_frame(frame, FrameNumber::data); }

/// The user calibration of a PNI TRAX, TCM3 or Prime (ICD section 11): output stopped, twelve points with
/// automatic sampling, kStartCal with limited tilt. The device answers kUserCalSampCount for each sample, and
/// kUserCalScore after the last. It uses the result at once; save() lets it keep it (kSave).
class PniCalibration final : public CompassCalibration {
 public:
  explicit PniCalibration(std::int64_t longest_ns) : longest_ns_(longest_ns) {}

  [[nodiscard]] std::string_view name() const override { return "pni"; }
  [[nodiscard]] std::string_view manoeuvre() const override {
    return "turn slowly through all headings, with as much tilt as possible";
  }
  std::string save(std::int64_t now_ns) override {
    if (busy()) return "it is under way: " + state();
    if (!score_) return "there is no result that the compass could keep";
    start_part(Part::saving, now_ns);
    return {};
  }
  [[nodiscard]] std::vector<Figure> figures() const override {
    if (!score_) return {};
    return {{"magnetometer", score_->magnetometer},
            {"accelerometer", score_->accelerometer},
            {"distribution_error", score_->distribution_error},
            {"tilt_error", score_->tilt_error},
            {"tilt_range_deg", score_->tilt_range_deg}};
  }

 private:
  Script script() override {
    if (part_ == Part::saving) {
      doing_ = "saving the result";
      if (!co_await ask(trax::encode_frame(FrameNumber::save), kPniRepeats, kPniSaves_ns,
                        [this](const protocols::Frame& frame) { return is_saved(frame); }))
        fail("no answer to the order to save");
      co_return;
    }
    if (part_ == Part::calibrating) {
      doing_ = "preparing the compass";
      co_await send(trax::encode_frame(FrameNumber::stop_continuous), kPniSettles_ns);
      if (!co_await ask(trax::encode_setting(trax::Setting::calibration_points, kPoints), kPniRepeats,
                        kPniReply_ns, is_done)) {
        fail("no answer to the number of samples");
      } else if (!co_await ask(trax::encode_setting(trax::Setting::automatic_sampling, 1), kPniRepeats,
                               kPniReply_ns, is_done)) {
        fail("no answer to automatic sampling");
      } else {
        may_calibrate_ = true;
        turning_ = touched_ =
            co_await ask(trax::encode_start_calibration(trax::Calibration::limited_tilt), kPniRepeats,
                         kPniSaves_ns, [this](const protocols::Frame& frame) { return count(frame) || score_; });
        if (!touched_) fail("no answer to the start of the calibration");
        if (turning_ && !score_) {
          const bool scored = co_await wait(longest_ns_, [this](const protocols::Frame& frame) {
            count(frame);
            return score_.has_value();
          });
          if (!scored)
            fail(fmt::format("only {} of {} samples in {} minutes", samples_, kPoints,
                             longest_ns_ / (60 * base::kSecond_ns)));
        }
        turning_ = false;
      }
      part_ = score_ ? Part::resuming : after_turning();
    }
    doing_ = "putting the compass back to service";
    if (part_ == Part::closing) co_await send(trax::encode_frame(FrameNumber::stop_calibration), kPniSettles_ns);
    part_ = Part::resuming;
    // A device that is polled sends nothing; StartUp asks it, and sees a silence.
    co_await ask(trax::encode_frame(FrameNumber::start_continuous), kPniRepeats, kPniSaves_ns, is_measurement);
  }

  /// Takes what the device says of its samples; true for their number.
  bool count(const protocols::Frame& frame) {
    const auto number = trax::decode_sample_count(frame.bytes);
    if (number) samples_ = *number;
    if (const auto score = trax::decode_score(frame.bytes)) score_ = *score;
    return number.has_value();
  }
  bool is_saved(const protocols::Frame& frame) {
    const auto saved = trax::decode_save_done(frame.bytes);
    saved_ = saved.value_or(false);
    if (saved && !saved_) fail("the compass could not save its result");
    return saved.has_value();
  }
  void forget_results() override {
    saved_ = false;
    samples_ = 0;
    score_.reset();
  }
  [[nodiscard]] std::string called_off() const override {
    return fmt::format("called off after {} of {} samples", samples_, kPoints);
  }
  [[nodiscard]] std::string progress() const override {
    return fmt::format("{} of {} samples", samples_, kPoints);
  }
  [[nodiscard]] std::string result() const override {
    return fmt::format("score {:.2f}, distribution error {:.2f}, tilt error {:.2f}, tilt range {:.0f} deg; {}",
                       score_->magnetometer, score_->distribution_error, score_->tilt_error,
                       score_->tilt_range_deg, saved_ ? "saved" : "kept until the compass loses its power");
  }

  std::int64_t longest_ns_;
  bool saved_ = false;
  std::uint32_t samples_ = 0;
  std::optional<trax::Score> score_;
};

}  // namespace

std::unique_ptr<CompassCalibration> calibrate_pni(std::int64_t longest_ns) {
  return std::make_unique<PniCalibration>(longest_ns);
}

}  // namespace navcal::instruments
