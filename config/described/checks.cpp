// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "config/described/parts.h"

namespace navcal::config::described {
namespace {

using protocols::described::Field;
using protocols::described::FrameKind;
using protocols::described::Meaning;
using protocols::described::Sum;

/// Bytes from `first` up to `last`, `last` excluded.
struct Extent {
  std::size_t first = 0, last = 0;

  [[nodiscard]] bool overlaps(const Extent& other) const { return first < other.last && other.first < last; }
};

class FrameCheck {
 public:
  FrameCheck(const FrameKind& kind, const Node& node, const std::vector<const Node*>& fields,
             std::vector<Problem>& problems)
      : kind_(kind), node_(node), fields_(fields), problems_(problems), before_(problems.size()),
        length_(kind.length.fixed) {}

  void check_binary() {
    if (!check_length()) return;
    check_constants();
    check_sum(length_);
    if (kind_.length.fixed == 0 && problems_.size() == before_) check_sum(kind_.length.longest);
    for (std::size_t i = 0; i < kind_.fields.size(); ++i) check_place(kind_.fields[i], *fields_[i]);
  }
  void check_text() {
    for (std::size_t i = 0; i < kind_.fields.size(); ++i) {
      const Field& field = kind_.fields[i];
      const std::size_t last = std::max(field.at, field.sign_at);
      if (kind_.count > 0 && last > kind_.count)
        complain(*fields_[i], "number", fmt::format("{} is beyond the {} fields of the line", last, kind_.count));
    }
  }
  void check_meanings();

 private:
  void complain(const Node& table, std::string_view key, std::string message) {
    const auto found = std::ranges::find(table.children, key, &Node::key);
    problems_.push_back({found != table.children.end() ? found->line : table.line,
                         fmt::format("{}.{}", table.name, key), std::move(message)});
  }

  static long placed(int place, std::size_t length) {
    return place < 0 ? static_cast<long>(length) + place : place;
  }
  [[nodiscard]] Extent extent_of_sum() const {
    const auto at = static_cast<std::size_t>(placed(kind_.checksum.at, length_));
    return {at, at + size_of(kind_.checksum.sum)};
  }

  bool check_length() {
    if (length_ == 0) {
      length_ = protocols::described::least_length(kind_);
      if (length_ > kind_.length.longest)
        complain(node_, "length",
                 fmt::format("at most {} bytes, and {} are needed at least", kind_.length.longest, length_));
      return length_ <= kind_.length.longest;
    }
    if (kind_.start.size() <= length_) return true;
    complain(node_, "length", fmt::format("{} bytes are shorter than sync", length_));
    return false;
  }

  void check_constants() {
    for (const auto& constant : kind_.constants) {
      if (constant.at < kind_.start.size())
        complain(node_, "constant", fmt::format("the one at {} lies in sync", constant.at));
      if (constant.at + constant.bytes.size() > length_)
        complain(node_, "constant",
                 fmt::format("the one at {} ends beyond the {} bytes of the frame", constant.at, length_));
    }
  }

  void check_sum(std::size_t whole) {
    const auto& sum = kind_.checksum;
    if (sum.sum == Sum::none) return;
    const long at = placed(sum.at, whole), from = placed(sum.from, whole), to = placed(sum.to, whole);
    const long length = static_cast<long>(whole), size = static_cast<long>(size_of(sum.sum));
    if (at < 0 || at + size > length || from < 0 || to > length || to < 0) {
      complain(node_, "checksum", fmt::format("it lies beyond the {} bytes of the frame", whole));
      return;
    }
    if (from >= to) complain(node_, "checksum", fmt::format("it covers nothing: from {} up to {}", from, to));
    if (from < at + size && at < to)
      complain(node_, "checksum",
               fmt::format("it covers itself: bytes {} to {}, and it stands at {}", from, to - 1, at));
    const Extent extent = extent_of_sum();
    if (extent.overlaps({0, kind_.start.size()})) complain(node_, "checksum", "it overlaps sync");
    for (const auto& constant : kind_.constants) {
      if (extent.overlaps({constant.at, constant.at + constant.bytes.size()}))
        complain(node_, "checksum", fmt::format("it overlaps the constant at {}", constant.at));
    }
  }

  void check_place(const Field& field, const Node& node) {
    const Extent extent{field.at, field.at + size_of(field.type)};
    const bool is_fixed = kind_.length.fixed != 0;
    const std::size_t longest = is_fixed ? length_ : kind_.length.longest;
    if (extent.last > longest) {
      complain(node, "at",
               fmt::format("bytes {} to {} are beyond the {} bytes of the frame", extent.first, extent.last - 1,
                           longest));
      return;
    }
    if (extent.overlaps({0, kind_.start.size()})) complain(node, "at", "it overlaps sync");
    const bool sum_is_known = kind_.checksum.sum != Sum::none && (is_fixed || kind_.checksum.at >= 0);
    if (sum_is_known && extent.overlaps(extent_of_sum())) complain(node, "at", "it overlaps the checksum");
  }

  const FrameKind& kind_;
  const Node& node_;
  const std::vector<const Node*>& fields_;
  std::vector<Problem>& problems_;
  std::size_t before_;  ///< problems of what was checked before
  std::size_t length_;  ///< of a frame that states it: the least
};

/// Meanings that a sample has together or not at all.
constexpr std::array<std::array<Meaning, 3>, 8> kTogether{{
    {Meaning::rate_x, Meaning::rate_y, Meaning::rate_z},
    {Meaning::specific_force_x, Meaning::specific_force_y, Meaning::specific_force_z},
    {Meaning::field_x, Meaning::field_y, Meaning::field_z},
    {Meaning::bottom_velocity_x, Meaning::bottom_velocity_y, Meaning::bottom_velocity_z},
    {Meaning::bottom_velocity_north, Meaning::bottom_velocity_east, Meaning::bottom_velocity_down},
    {Meaning::water_velocity_x, Meaning::water_velocity_y, Meaning::water_velocity_z},
    {Meaning::water_velocity_north, Meaning::water_velocity_east, Meaning::water_velocity_down},
    {Meaning::latitude, Meaning::longitude, Meaning::longitude},
}};

/// Meanings of which a frame has one.
constexpr std::array<std::array<Meaning, 2>, 3> kEither{{
    {Meaning::heading, Meaning::heading_true},
    {Meaning::bottom_velocity_x, Meaning::bottom_velocity_north},
    {Meaning::water_velocity_x, Meaning::water_velocity_north},
}};

void FrameCheck::check_meanings() {
  std::set<Meaning> meanings;
  for (std::size_t i = 0; i < kind_.fields.size(); ++i) {
    const Field& field = kind_.fields[i];
    const auto same = [&](const Field& other) {
      return other.name == field.name || (field.meaning > Meaning::sensor && other.meaning == field.meaning);
    };
    const auto first = std::find_if(kind_.fields.begin(), kind_.fields.end(), same);
    if (const auto before = static_cast<std::size_t>(first - kind_.fields.begin()); before < i) {
      const bool is_meaning = first->meaning == field.meaning && field.meaning > Meaning::sensor;
      complain(*fields_[i],
               is_meaning                         ? "meaning"
               : field.meaning == Meaning::sensor ? "sensor"
                                                  : "name",
               fmt::format("{} is already that of the field in line {}",
                           is_meaning ? info_of(field.meaning).name : std::string_view(field.name),
                           fields_[before]->line));
    }
    meanings.insert(field.meaning);
  }
  for (const auto& together : kTogether) {
    const auto is_there = [&](Meaning meaning) { return meanings.count(meaning) > 0; };
    if (std::none_of(together.begin(), together.end(), is_there)) continue;
    for (const Meaning meaning : std::set<Meaning>(together.begin(), together.end())) {
      if (!is_there(meaning))
        complain(node_, "field",
                 fmt::format("{} is missing: {}", info_of(meaning).name,
                             together[1] == together[2] ? "a position has latitude and longitude"
                                                        : "all three axes are needed"));
    }
  }
  for (const auto& [one, other] : kEither) {
    if (meanings.count(one) > 0 && meanings.count(other) > 0)
      complain(node_, "field", fmt::format("{} and {} in one frame", info_of(one).name, info_of(other).name));
  }
}

}  // namespace

void check_frame(const FrameKind& kind, bool is_text, const Node& node, const std::vector<const Node*>& fields,
                 std::vector<Problem>& problems) {
  FrameCheck check(kind, node, fields, problems);
  if (is_text) {
    check.check_text();
  } else {
    check.check_binary();
  }
  check.check_meanings();
}

}  // namespace navcal::config::described
