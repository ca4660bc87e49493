// SPDX-License-Identifier: Apache-2.0
#include "protocols/described/plan.h"

#include <algorithm>
#include <cctype>

namespace navcal::protocols::described {
namespace {

bool is_nmea_line(const FrameKind& kind) {
  const Checksum& sum = kind.checksum;
  return sum.sum == Sum::xor8 && sum.mark == '*' && sum.from == 1 && kind.end == '\n' &&
         kind.start.starts_with('$');
}

template <std::size_t Size>
std::uint32_t unsigned_at(const std::uint8_t* p, bool is_big) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < Size; ++i) value |= std::uint32_t{p[i]} << 8 * (is_big ? Size - 1 - i : i);
  return value;
}

}  // namespace

KindPlan::KindPlan(const FrameKind& kind, bool text)
    : FrameKind(kind), least(text ? 1 : least_length(kind)),
      longest(std::min(kind.length.longest, kMaxFrameLength)), sum_size(size_of(kind.checksum.sum)),
      is_text(text) {
  fields.clear();
  is_nmea = text && is_nmea_line(kind);
  starts_anywhere = text && start.empty();
  start_is_sign = text && !start.empty() && std::isalnum(static_cast<unsigned char>(start.front())) == 0;
}

std::shared_ptr<const Plan> compile(const Description& description) {
  auto plan = std::make_shared<Plan>();
  bool all_summed = true;
  for (const FrameKind& kind : description.kinds) {
    plan->kinds.emplace_back(kind, description.is_text);
    if (!kind.start.empty()) {
      plan->starts.at(static_cast<std::uint8_t>(kind.start.front())) = true;
      continue;
    }
    plan->any_starts_anywhere = true;
    plan->ends.at(static_cast<std::uint8_t>(kind.end)) = true;
    all_summed = all_summed && kind.checksum.sum != Sum::none;
  }
  plan->beginning_counts = plan->any_starts_anywhere && all_summed;
  if (!plan->any_starts_anywhere && std::count(plan->starts.begin(), plan->starts.end(), true) == 1) {
    plan->sole_start =
        static_cast<int>(std::find(plan->starts.begin(), plan->starts.end(), true) - plan->starts.begin());
  }
  return plan;
}

std::int64_t integer_at(const std::uint8_t* p, Type type, bool is_big) {
  switch (type) {
    case Type::u8: return *p;
    case Type::i8: return static_cast<std::int8_t>(*p);
    case Type::u16: return unsigned_at<2>(p, is_big);
    case Type::i16: return static_cast<std::int16_t>(unsigned_at<2>(p, is_big));
    case Type::u24: return unsigned_at<3>(p, is_big);
    case Type::i24: return static_cast<std::int32_t>(unsigned_at<3>(p, is_big) << 8) >> 8;
    case Type::u32: return unsigned_at<4>(p, is_big);
    case Type::i32: return static_cast<std::int32_t>(unsigned_at<4>(p, is_big));
    default: return 0;
  }
}

}  // namespace navcal::protocols::described
