// SPDX-License-Identifier: Apache-2.0
#include "web/log_history.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/asio/local/stream_protocol.hpp>
#include <boost/asio/read_until.hpp>
#include <boost/asio/write.hpp>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include "ports/no_throw.h"
#include "record/json/base64.h"
#include "record/json/json_members.h"
#include "record/log/checksum.h"
#include "web/message_fields.h"

namespace navcal::web {
namespace asio = boost::asio;
using ports::kNoThrow;
namespace {

/// As much as navcald reads at once.
constexpr std::uint64_t kPiece_bytes = 65536;
constexpr int kMostPieces = 300;
/// A reading serves those who ask within this time.
constexpr auto kLife = std::chrono::seconds(10);
constexpr double kSpan_s = 1800;
/// Pieces lie a thirtieth of their age apart, and at most this: the plots show a gap from 10 s on.
constexpr double kAgeShare = 1.0 / 30;
constexpr double kWidest_s = 8;
/// An answer with a piece, in base64.
constexpr std::size_t kMaxAnswer = 128 << 10;

/// The messages that the plots show, by their class.
constexpr std::pair<std::string_view, std::string_view> kPlotted[] = {
    {"NAV", "/nav"}, {"IMU", "/imu"}, {"DEPTH", "/depth"}, {"MOTOR", "/motor"}};
constexpr std::string_view kBegin = R"({"class":")";
constexpr std::string_view kEnd = R"(,"crc":")";

/// One connection to navcald. Throws std::runtime_error with the reason in words.
class Connection {
 public:
  Connection(const asio::any_io_executor& executor, const std::filesystem::path& path, std::chrono::seconds limit)
      : socket_(std::make_shared<asio::local::stream_protocol::socket>(executor)), limit_(executor) {
    boost::system::error_code error;
    socket_->connect(asio::local::stream_protocol::endpoint(path.string()), error);
    if (error) throw std::runtime_error("navcald's control socket " + path.string() + ": " + error.message());
    limit_.expires_after(limit);
    limit_.async_wait([socket = socket_](boost::system::error_code cancelled) {
      boost::system::error_code ignored;
      if (!cancelled) socket->close(ignored);
    });
  }

  asio::awaitable<nlohmann::json> ask(nlohmann::json request) {
    const std::string line = request.dump() + "\n";
    const auto [unsent, written] = co_await asio::async_write(*socket_, asio::buffer(line), kNoThrow);
    if (unsent) throw std::runtime_error("navcald ended the connection, or did not answer in time");
    const auto [unread, length] =
        co_await asio::async_read_until(*socket_, asio::dynamic_buffer(received_, kMaxAnswer), '\n', kNoThrow);
    if (unread) throw std::runtime_error("navcald ended the connection, or did not answer in time");
    auto answer = nlohmann::json::parse(received_.substr(0, length));
    received_.erase(0, length);
    if (!answer.value("ok", false)) throw std::runtime_error("navcald: " + answer.value("error", ""));
    co_return answer;
  }

 private:
  std::shared_ptr<asio::local::stream_protocol::socket> socket_;
  asio::steady_timer limit_;
  std::string received_;
};

/// The first whole message of each class and device in a piece of a log, as rows; the time of the first.
struct Piece {
  std::string rows;
  std::optional<double> time_s;
};

Piece rows_in(std::string_view bytes) {
  Piece piece;
  std::set<std::string> known;
  for (auto at = bytes.find(kBegin); at != std::string_view::npos; at = bytes.find(kBegin, at + 1)) {
    const auto plotted = std::find_if(std::begin(kPlotted), std::end(kPlotted), [&](const auto& one) {
      return bytes.substr(at + kBegin.size()).starts_with(one.first) &&
             bytes.substr(at + kBegin.size() + one.first.size()).starts_with('"');
    });
    const auto end = plotted == std::end(kPlotted) ? std::string_view::npos : bytes.find(kEnd, at);
    if (end == std::string_view::npos || end + record::kJsonTail > bytes.size()) continue;
    const std::string_view message = bytes.substr(at, end + record::kJsonTail - at);
    const auto time_s = member_number(message, "time");
    const std::string_view device = member_text(message, "device");
    std::string key = fmt::format("{} {}", plotted->second, device);
    if (!time_s || known.contains(key) || !record::json_crc_holds(message) || !nlohmann::json::accept(message))
      continue;
    known.insert(std::move(key));
    if (!piece.time_s) piece.time_s = time_s;
    piece.rows +=
        fmt::format(R"({}["{}","{}",{}])", piece.rows.empty() ? "" : ",", plotted->second, device, message);
  }
  return piece;
}

/// Chooses the next older piece of the logs, by the bytes a second between the last two pieces.
class Steps {
 public:
  /// False when the span is full.
  bool take(const Piece& piece) {
    if (!piece.time_s) return true;
    if (!newest_s_) newest_s_ = piece.time_s;
    if (before_s_ && *before_s_ > *piece.time_s) rate_ = bytes_ / (*before_s_ - *piece.time_s);
    before_s_ = piece.time_s;
    bytes_ = 0;
    return *newest_s_ - *before_s_ < kSpan_s;
  }
  /// The end of the next older piece in a log with `end` unread bytes; 0 when the log has no more. The first piece
  /// of a log is always read, because the log before it ends there.
  std::uint64_t next_end(std::uint64_t end) {
    const double apart_s = newest_s_ ? std::min((*newest_s_ - *before_s_) * kAgeShare, kWidest_s) : 0;
    const auto skipped =
        static_cast<std::uint64_t>(std::max(0.0, rate_ * apart_s - static_cast<double>(kPiece_bytes)));
    const std::uint64_t next = end > skipped ? end - skipped : std::min(end, kPiece_bytes);
    bytes_ += static_cast<double>(end - next + (next == 0 ? kPiece_bytes : std::min(next, kPiece_bytes)));
    return next;
  }

 private:
  std::optional<double> newest_s_, before_s_;
  double bytes_ = 0, rate_ = 0;
};

/// Fills `pieces` from the newest back, so that what was read before a failure is kept.
asio::awaitable<void> read_pieces(Connection& navcald, std::vector<std::string>& pieces) {
  std::vector<std::pair<std::string, std::uint64_t>> logs;
  for (bool more = true; more;) {
    // Named, because g++ 12 destroys temporaries of an awaited expression twice.
    auto list = navcald.ask({{"command", "log.list"}, {"after", logs.empty() ? "" : logs.back().first}});
    const auto page = co_await std::move(list);
    for (const auto& log : page.at("files")) logs.emplace_back(log.at("name"), log.at("bytes"));
    more = page.at("more").get<bool>();
  }
  Steps steps;
  int count = 0;
  for (; !logs.empty(); logs.pop_back()) {
    auto [name, end] = logs.back();
    while (end > 0) {
      if (++count > kMostPieces) co_return;
      const std::uint64_t length = std::min(kPiece_bytes, end);
      auto read =
          navcald.ask({{"command", "log.read"}, {"file", name}, {"offset", end - length}, {"length", length}});
      const auto part = co_await std::move(read);
      const auto bytes = record::from_base64(part.at("data").get<std::string>());
      Piece piece = rows_in(bytes.value_or(""));
      const bool goes_on = steps.take(piece);
      if (!piece.rows.empty()) pieces.push_back(std::move(piece.rows));
      if (!goes_on) co_return;
      end = steps.next_end(end - length);
    }
  }
}

}  // namespace

LogHistory::LogHistory(const asio::any_io_executor& executor, std::filesystem::path control_socket,
                       std::chrono::seconds limit)
    : control_socket_(std::move(control_socket)), limit_(limit), done_(executor) {}

asio::awaitable<LogHistory::Text> LogHistory::json() {
  while (is_reading_) co_await done_.async_wait(kNoThrow);
  if (text_ && std::chrono::steady_clock::now() - made_ < kLife) co_return text_;
  is_reading_ = true;
  done_.expires_at(std::chrono::steady_clock::time_point::max());
  text_ = co_await read();
  made_ = std::chrono::steady_clock::now();
  is_reading_ = false;
  done_.cancel();
  co_return text_;
}

asio::awaitable<LogHistory::Text> LogHistory::read() {
  std::vector<std::string> pieces;
  nlohmann::json problem;
  try {
    Connection navcald(done_.get_executor(), control_socket_, limit_);
    co_await read_pieces(navcald, pieces);
  } catch (const std::exception& error) {
    problem = error.what();
  }
  std::reverse(pieces.begin(), pieces.end());
  co_return std::make_shared<const std::string>(
      fmt::format(R"({{"problem":{},"records":[{}]}})", record::json_text(problem), fmt::join(pieces, ",")));
}

void add_history(Site& site, LogHistory& history) {
  site.add("GET", "/history.json", [&history](const Request&) -> asio::awaitable<Response> {
    const auto text = co_await history.json();
    co_return respond_json(boost::beast::http::status::ok, *text);
  });
}

}  // namespace navcal::web
