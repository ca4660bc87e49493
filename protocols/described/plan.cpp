// SPDX-License-Identifier: Apache-2.0
#include "protocols/described/plan.h"

#include <algorithm>
#include <cctype>

namespace navcal::protocols::described {
namespace {

bool is_nmea_line(const KindPlan& kind) {
  const Checksum& sum = kind.checksum;
  return sum.sum == Sum::xor8 && sum.mark == '*' && sum.from == 1 && kind.end == '\n' &&
         kind.start.starts_with('$');
}

KindPlan plan_of(const FrameKind& kind, bool is_text) {
  KindPlan plan;
  plan.id = kind.id;
  plan.start = kind.start;
  plan.constants = kind.constants;
  plan.length = {kind.length.at, kind.length.type, kind.length.byte_order == ByteOrder::big};
  plan.fixed_length = kind.length.fixed;
  plan.least = is_text ? 1 : least_length(kind);
  plan.longest = std::min(kind.length.longest, kMaxFrameLength);
  plan.times = kind.length.times;
  plan.add = kind.length.add;
  plan.checksum = kind.checksum;
  plan.sum_size = size_of(kind.checksum.sum);
  plan.end = kind.end;
  plan.separator = kind.separator;
  plan.count = kind.count;
  plan.is_text = is_text;
  plan.is_nmea = is_text && is_nmea_line(plan);
  plan.starts_anywhere = is_text && kind.start.empty();
  plan.start_is_sign =
      is_text && !kind.start.empty() && std::isalnum(static_cast<unsigned char>(kind.start.front())) == 0;
  return plan;
}

template <std::size_t Size>
std::uint32_t unsigned_at(const std::uint8_t* p, bool is_big) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < Size; ++i) value |= std::uint32_t{p[i]} << 8 * (is_big ? Size - 1 - i : i);
  return value;
}

}  // namespace

std::shared_ptr<const Plan> compile(const Description& description) {
  auto plan = std::make_shared<Plan>();
  bool all_summed = true;
  for (const FrameKind& kind : description.kinds) {
    plan->kinds.push_back(plan_of(kind, description.is_text));
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
