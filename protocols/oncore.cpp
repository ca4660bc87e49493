// SPDX-License-Identifier: Apache-2.0
#include "protocols/oncore.h"

#include <string_view>

#include "protocols/checked_line.h"
#include "protocols/oncore_encode.h"

namespace navcal::protocols::oncore {
namespace {

struct Length {
  std::string_view letters;
  std::uint16_t bytes;
};

constexpr Length kLengths[] = {
    {"Aa", 10},  {"Ab", 10},  {"Ac", 11}, {"Ad", 11}, {"Ae", 11}, {"Af", 15}, {"Ag", 8},  {"Ap", 25},  {"Aq", 8},
    {"As", 20},  {"At", 8},   {"Au", 12}, {"Av", 8},  {"Aw", 8},  {"Ay", 11}, {"Az", 11}, {"AB", 8},   {"AM", 11},
    {"AN", 8},   {"AO", 8},   {"AP", 8},  {"AQ", 8},  {"Ba", 68}, {"Bb", 92}, {"Bd", 23}, {"Bj", 8},   {"Bl", 41},
    {"Bn", 59},  {"Bo", 8},   {"Ca", 9},  {"Cb", 33}, {"Cc", 80}, {"Ce", 52}, {"Cf", 7},  {"Cg", 8},   {"Ch", 9},
    {"Cj", 294}, {"Ck", 7},   {"Co", 29}, {"Ea", 76}, {"Ek", 71}, {"En", 69}, {"Eq", 96}, {"Fa", 9},   {"Ga", 20},
    {"Gb", 17},  {"Gc", 8},   {"Gd", 8},  {"Ge", 8},  {"Gf", 9},  {"Gj", 21}, {"Gk", 13}, {"Ha", 154}, {"Hb", 54},
    {"Hn", 78},  {"Hr", 170}, {"Ia", 10}, {"Sz", 8},
};

constexpr std::size_t kLetters = 'z' - 'A' + 1;
constexpr std::size_t kShortest = 7;

constexpr bool is_letter(std::uint8_t c) { return c >= 'A' && c <= 'z'; }

struct Table {
  std::array<std::array<std::uint16_t, kLetters>, kLetters> length{};
  std::array<bool, kLetters> begins{};  // some response begins with this letter

  constexpr Table() {
    for (const auto& [letters, bytes] : kLengths) {
      const auto first = static_cast<std::size_t>(letters[0] - 'A');
      length[first][static_cast<std::size_t>(letters[1] - 'A')] = bytes;
      begins[first] = true;
    }
  }
};
constexpr Table kTable;

constexpr std::size_t kTrailer = 2;  // CR LF

// Eq ends in three decimal digits instead of one byte. The manual does not say whether the comma before them
// belongs to the sum: both are taken.
bool eq_checksum_holds(const std::uint8_t* first, std::size_t length) {
  const std::size_t digits = length - kTrailer - 3;
  unsigned stated = 0;
  for (std::size_t i = digits; i < digits + 3; ++i) {
    if (first[i] < '0' || first[i] > '9') return false;
    stated = stated * 10 + (first[i] - static_cast<unsigned>('0'));
  }
  const unsigned sum = xor_of(Bytes(first + 2, digits - 2));
  return stated == sum || (first[digits - 1] == ',' && stated == (sum ^ static_cast<unsigned>(',')));
}

bool checksum_holds(const std::uint8_t* first, std::size_t length) {
  if (first[2] == 'E' && first[3] == 'q') return eq_checksum_holds(first, length);
  const std::size_t checksum = length - kTrailer - 1;
  return xor_of(Bytes(first + 2, checksum - 2)) == first[checksum];
}

}  // namespace

std::size_t response_length(std::uint8_t first, std::uint8_t second) {
  if (!is_letter(first) || !is_letter(second)) return 0;
  return kTable.length[first - 'A'][second - 'A'];
}

Scan Scanner::scan(const std::uint8_t* first, const std::uint8_t* last) {
  const auto available = static_cast<std::size_t>(last - first);
  if (available < 2) return Scan::incomplete(kShortest - available);
  if (first[1] != '@') return Scan::not_a_frame();
  if (available < 3) return Scan::incomplete(kShortest - available);
  if (!is_letter(first[2]) || !kTable.begins[first[2] - 'A']) return Scan::not_a_frame();
  if (available < 4) return Scan::incomplete(kShortest - available);
  const std::size_t length = response_length(first[2], first[3]);
  if (length == 0) return Scan::not_a_frame();

  // Each byte of the end is judged as soon as it is there, so that a false start is left at the first chance.
  if (available >= length - kTrailer && !checksum_holds(first, length)) return Scan::bad_checksum();
  if (available >= length - 1 && first[length - 2] != '\r') return Scan::bad_checksum();
  if (available < length) return Scan::incomplete(length - available);
  if (first[length - 1] != '\n') return Scan::bad_checksum();
  const char letters[2] = {static_cast<char>(first[2]), static_cast<char>(first[3])};
  return Scan::frame(length, FrameId(std::string_view(letters, 2)));
}

std::vector<std::uint8_t> encode_frame(FrameId id, Bytes data) {
  std::vector<std::uint8_t> frame{'@', '@'};
  frame.reserve(data.size() + 7);
  for (const char letter : id.view()) frame.push_back(static_cast<std::uint8_t>(letter));
  frame.insert(frame.end(), data.begin(), data.end());
  frame.push_back(xor_of(Bytes(frame).subspan(2)));
  frame.push_back('\r');
  frame.push_back('\n');
  return frame;
}

}  // namespace navcal::protocols::oncore
