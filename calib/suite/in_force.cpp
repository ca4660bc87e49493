// SPDX-License-Identifier: Apache-2.0
#include "calib/suite/in_force.h"

#include <algorithm>
#include <array>
#include <cstdio>

namespace navcal::calib {
namespace {

/// FNV-1a, 32 bits.
std::uint32_t sum_of(std::string_view bytes) {
  std::uint32_t sum = 2166136261U;
  for (const char c : bytes) sum = (sum ^ static_cast<unsigned char>(c)) * 16777619U;
  return sum;
}

}  // namespace

std::string CorrectionName::text() const {
  if (number == 0) return "none";
  std::array<char, 32> text{};
  const int length = std::snprintf(text.data(), text.size(), "%u-%08x", number, sum);
  return std::string(text.data(), static_cast<std::size_t>(length));
}

std::size_t InForce::steps_back(Calibrator calibrator) const {
  return static_cast<std::size_t>(std::count_if(
      history_.begin(), history_.end(), [&](const Change& change) { return change.calibrator == calibrator; }));
}

void InForce::adopt(Calibrator calibrator, const Correction& from) {
  if (history_.size() == kDepth) history_.erase(history_.begin());
  history_.push_back({calibrator, correction_});
  copy_value(correction_, from, calibrator);
  rename();
}

bool InForce::roll_back(Calibrator calibrator) {
  const auto last = std::find_if(history_.rbegin(), history_.rend(),
                                 [&](const Change& change) { return change.calibrator == calibrator; });
  if (last == history_.rend()) return false;
  copy_value(correction_, last->before, calibrator);
  history_.erase(std::next(last).base());
  rename();
  return true;
}

void InForce::move_hard_iron(const Eigen::Vector3d& by_uT) {
  for (Change& change : history_) {
    if (auto& field = change.before.magnetometer) field->offset_uT += by_uT;
  }
  if (!correction_.magnetometer) return;
  correction_.magnetometer->offset_uT += by_uT;
  rename();
}

void InForce::rename() {
  ++name_.number;
  Archive content;
  content(correction_);
  name_.sum = sum_of(content.bytes());
}

void InForce::Change::archive(Archive& archive) {
  calib::archive(archive, calibrator);
  archive(before);
}

void InForce::archive(Archive& archive) {
  archive.tag("in_force 1");
  archive(correction_, name_.number, name_.sum, history_);
  if (history_.size() > kDepth) history_.resize(kDepth);
}

}  // namespace navcal::calib
