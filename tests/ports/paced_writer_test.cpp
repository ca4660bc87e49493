// SPDX-License-Identifier: Apache-2.0
#include "ports/paced_writer.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/ports/harness.h"

namespace navcal::ports::testing {
namespace {

struct Pieces {
  boost::asio::io_context io{1};
  std::string put;
  std::vector<std::int64_t> times_ns;
  std::vector<std::size_t> sizes;
  PacedWriter writer{io.get_executor(), [this](std::int64_t now_ns, protocols::Bytes piece) {
                       put.append(piece.begin(), piece.end());
                       times_ns.push_back(now_ns);
                       sizes.push_back(piece.size());
                     }};
};

TEST(PacedWriter, KeepsOrderWhateverTheSizesAndTimes) {
  Pieces line;
  std::mt19937 random(2);
  std::string sent;
  std::int64_t start = monotonic_ns();
  for (int i = 0; i < 200; ++i) {
    std::string piece(random() % 40, '\0');
    for (char& byte : piece) byte = static_cast<char>(random());
    sent += piece;
    line.writer.send(start, 921600, bytes_of(piece));
    start += static_cast<std::int64_t>(random() % 1'000'000);
  }
  ASSERT_TRUE(run_until(line.io, [&] { return line.writer.idle(); }));
  EXPECT_EQ(line.put, sent);
}

TEST(PacedWriter, NoPieceComesBeforeItsLastByteHasPassedTheWire) {
  Pieces line;
  const std::int64_t start = monotonic_ns() + 5'000'000;
  line.writer.send(start, 57600, bytes_of(std::string(22, 'i')));
  line.writer.send(start, 57600, bytes_of("j"));  // waits for the line
  ASSERT_TRUE(run_until(line.io, [&] { return line.writer.idle(); }));
  ASSERT_EQ(line.sizes, (std::vector<std::size_t>{16, 6, 1}));
  std::size_t passed = 0;
  for (std::size_t i = 0; i < line.sizes.size(); ++i) {
    passed += line.sizes[i];
    EXPECT_GE(line.times_ns[i], start + static_cast<std::int64_t>(passed) * 10'000'000'000 / 57600) << i;
  }
}

TEST(PacedWriter, ALateStartIsCaughtUpWithoutDrift) {
  Pieces line;
  const std::int64_t start = monotonic_ns() - 1'000'000'000;  // as after a second in which nothing ran
  for (int i = 0; i < 10; ++i) line.writer.send(start + i * 100'000'000, 9600, bytes_of("word\r\n"));
  ASSERT_TRUE(run_until(line.io, [&] { return line.writer.idle(); }));
  EXPECT_EQ(line.put.size(), 60U);
  EXPECT_LT(line.times_ns.back() - line.times_ns.front(), 500'000'000) << "not stretched by the delay";
}

TEST(PacedWriter, ClearedIsGone) {
  Pieces line;
  line.writer.send(monotonic_ns(), 300, bytes_of("a long time on the wire"));
  line.writer.clear();
  EXPECT_TRUE(line.writer.idle());
  line.writer.send(monotonic_ns(), 9600, bytes_of("b"));
  ASSERT_TRUE(run_until(line.io, [&] { return line.writer.idle(); }));
  EXPECT_EQ(line.put, "b");
}

TEST(PacedWriter, MayEndBeforeItsLastExpiryIsServed) {
  boost::asio::io_context io{1};
  {
    PacedWriter writer(io.get_executor(), [](std::int64_t, protocols::Bytes) { FAIL(); });
    writer.send(monotonic_ns() - 1'000'000'000, 9600, bytes_of("x"));
  }
  io.run();
}

}  // namespace
}  // namespace navcal::ports::testing
