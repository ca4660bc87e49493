// SPDX-License-Identifier: Apache-2.0
#include "instruments/pni_calibration.h"

#include <fmt/format.h>

#include <utility>

#include "base/durations.h"

namespace navcal::instruments {
namespace {

namespace trax = protocols::trax;
using trax::FrameNumber;

constexpr std::int64_t kNoDeadline_ns = std::numeric_limits<std::int64_t>::max();
constexpr std::int64_t kPniReply_ns = 500 * base::kMillisecond_ns;
/// kSave writes flash memory; a score needs some arithmetic.
constexpr std::int64_t kPniSaves_ns = 2 * base::kSecond_ns;
constexpr std::int64_t kPniSettles_ns = 100 * base::kMillisecond_ns;
constexpr int kPniRepeats = 3;

bool is_frame(const protocols::Frame& frame, FrameNumber number) {
  return frame.bytes.size() >= trax::kOverhead && frame.bytes[2] == static_cast<std::uint8_t>(number);
}

}  // namespace

void PniCalibration::enter(Phase phase, std::int64_t due_ns) {
  phase_ = phase;
  due_ns_ = due_ns;
  attempts_ = 0;
}

void PniCalibration::begin(std::int64_t now_ns) {
  touched_ = saved_ = false;
  samples_ = 0;
  score_.reset();
  failure_.clear();
  enter(Phase::halting, now_ns);
}

void PniCalibration::stop(std::int64_t now_ns) {
  switch (phase_) {
    case Phase::halting:
    case Phase::points:
    case Phase::sampling:
    case Phase::starting:
    case Phase::turning: return fail(fmt::format("called off after {} of {} samples", samples_, kPoints), now_ns);
    default: break;
  }
}

void PniCalibration::abandon(std::string reason) {
  if (phase_ == Phase::idle) return;
  if (failure_.empty() && !score_) failure_ = std::move(reason);
  enter(Phase::idle, kNoDeadline_ns);
}

std::string PniCalibration::save(std::int64_t now_ns) {
  if (busy()) return "it is under way: " + state();
  if (!score_) return "there is no result that the compass could keep";
  enter(Phase::saving, now_ns);
  return {};
}

void PniCalibration::fail(std::string reason, std::int64_t now_ns) {
  if (failure_.empty()) failure_ = std::move(reason);
  const bool may_calibrate = phase_ == Phase::starting || phase_ == Phase::turning;
  enter(may_calibrate ? Phase::stopping : Phase::resuming, now_ns);
}

void PniCalibration::on_frame(const protocols::Frame& frame, std::int64_t now_ns) {
  const bool configures = phase_ == Phase::points || phase_ == Phase::sampling;
  if (configures && attempts_ > 0 && is_frame(frame, FrameNumber::set_config_done)) {
    enter(phase_ == Phase::points ? Phase::sampling : Phase::starting, now_ns);
  } else if (const auto count = trax::decode_sample_count(frame.bytes)) {
    if (phase_ == Phase::starting && attempts_ > 0) {
      touched_ = true;
      enter(Phase::turning, now_ns + longest_ns_);
    }
    if (phase_ == Phase::turning) samples_ = *count;
  } else if (const auto score = trax::decode_score(frame.bytes)) {
    if (phase_ != Phase::turning && phase_ != Phase::starting) return;
    touched_ = true;
    score_ = *score;
    enter(Phase::resuming, now_ns);
  } else if (phase_ == Phase::resuming && attempts_ > 0 && is_frame(frame, FrameNumber::data)) {
    enter(Phase::idle, kNoDeadline_ns);
  } else if (phase_ == Phase::saving && attempts_ > 0) {
    if (const auto saved = trax::decode_save_done(frame.bytes)) {
      saved_ = *saved;
      if (!saved_) failure_ = "the compass could not save its result";
      enter(Phase::idle, kNoDeadline_ns);
    }
  }
}

void PniCalibration::on_unanswered(std::int64_t now_ns) {
  switch (phase_) {
    case Phase::points: return fail("no answer to the number of samples", now_ns);
    case Phase::sampling: return fail("no answer to automatic sampling", now_ns);
    case Phase::starting: return fail("no answer to the start of the calibration", now_ns);
    case Phase::saving: failure_ = "no answer to the order to save"; break;
    default: break;  // a device that is polled sends nothing; StartUp asks it, and sees a silence
  }
  enter(Phase::idle, kNoDeadline_ns);
}

std::optional<std::vector<std::uint8_t>> PniCalibration::next(std::int64_t now_ns) {
  if (now_ns < due_ns_) return std::nullopt;
  if (phase_ == Phase::turning)
    fail(fmt::format("only {} of {} samples in {} minutes", samples_, kPoints,
                     longest_ns_ / (60 * base::kSecond_ns)),
         now_ns);
  if (attempts_ >= kPniRepeats) on_unanswered(now_ns);
  const auto ask = [&](std::vector<std::uint8_t> bytes, std::int64_t patience_ns) {
    ++attempts_;
    due_ns_ = now_ns + patience_ns;
    return bytes;
  };
  switch (phase_) {
    case Phase::idle:
    case Phase::turning: return std::nullopt;
    case Phase::halting:
      enter(Phase::points, now_ns + kPniSettles_ns);
      return trax::encode_frame(FrameNumber::stop_continuous);
    case Phase::points: return ask(trax::encode_setting(trax::Setting::calibration_points, kPoints), kPniReply_ns);
    case Phase::sampling: return ask(trax::encode_setting(trax::Setting::automatic_sampling, 1), kPniReply_ns);
    case Phase::starting:
      return ask(trax::encode_start_calibration(trax::Calibration::limited_tilt), kPniSaves_ns);
    case Phase::stopping:
      enter(Phase::resuming, now_ns + kPniSettles_ns);
      return trax::encode_frame(FrameNumber::stop_calibration);
    case Phase::saving: return ask(trax::encode_frame(FrameNumber::save), kPniSaves_ns);
    case Phase::resuming: break;
  }
  return ask(trax::encode_frame(FrameNumber::start_continuous), kPniSaves_ns);
}

std::vector<CompassCalibration::Figure> PniCalibration::figures() const {
  if (!score_) return {};
  return {{"magnetometer", score_->magnetometer},
          {"accelerometer", score_->accelerometer},
          {"distribution_error", score_->distribution_error},
          {"tilt_error", score_->tilt_error},
          {"tilt_range_deg", score_->tilt_range_deg}};
}

std::string PniCalibration::state() const {
  std::string text;
  switch (phase_) {
    case Phase::idle:
      if (!failure_.empty()) return "failed: " + failure_;
      if (!score_) return "not begun";
      return fmt::format("score {:.2f}, distribution error {:.2f}, tilt error {:.2f}, tilt range {:.0f} deg; {}",
                         score_->magnetometer, score_->distribution_error, score_->tilt_error,
                         score_->tilt_range_deg, saved_ ? "saved" : "kept until the compass loses its power");
    case Phase::turning: return fmt::format("{} of {} samples", samples_, kPoints);
    case Phase::saving: return "saving the result";
    case Phase::stopping:
    case Phase::resuming: text = "putting the compass back to service"; break;
    default: text = "preparing the compass"; break;
  }
  return failure_.empty() ? text : text + "; failed: " + failure_;
}

}  // namespace navcal::instruments
