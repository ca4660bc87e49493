// SPDX-License-Identifier: Apache-2.0
#include "web/audit_peer.h"

#include <fmt/format.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <array>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>

#include "base/spawn.h"
#include "base/temporary_folder.h"
#include "ports/pseudo_terminal.h"
#include "record/json/json_members.h"
#include "web/http.h"

namespace navcal::web {
namespace asio = boost::asio;
namespace fs = std::filesystem;
namespace {

/// Only the client that holds the turn has an audit.
using AuditTurn = std::shared_ptr<const char>;

/// Takes a log, audits it in a process of its own, and gives the page. Process and files go with this object.
class AuditPeer final : public Peer {
 public:
  AuditPeer(const asio::any_io_executor& executor, PeerLink& link, std::weak_ptr<const char>& last_turn)
      : link_(link), last_turn_(last_turn), words_(executor) {}
  ~AuditPeer() override { drop(); }
  AuditPeer(const AuditPeer&) = delete;
  AuditPeer& operator=(const AuditPeer&) = delete;

  void on_open() override {
    attempt([this] {
      if (!link_.is_from_here())
        throw std::runtime_error(
            "logs are taken from a browser on the same computer only; elsewhere: navcal audit");
    });
  }
  void on_text(std::string_view text) override {
    attempt([&] {
      constexpr std::uint64_t kMaxLog_bytes = 1ULL << 30;
      const auto request = nlohmann::json::parse(text);
      bytes_ = request.at("bytes").get<std::uint64_t>();
      const fs::path name = request.at("name").get<std::string>();
      if (!last_turn_.expired()) throw std::runtime_error("another audit is running");
      if (bytes_ == 0) throw std::runtime_error("the file is empty");
      if (bytes_ > kMaxLog_bytes) throw std::runtime_error("the file has more than 1 GiB; navcal audit takes it");
      last_turn_ = turn_ = std::make_shared<char>();
      file_ = folder_.emplace().path() / "log" / name.filename();
      fs::create_directory(file_.parent_path());
      log_.open(file_, std::ios::binary);
      link_.send_text(R"({"received":0})");
    });
  }
  void on_binary(std::string_view piece) override {
    attempt([&] {
      received_ += piece.size();
      if (received_ > bytes_) throw std::runtime_error("more came than the file was said to have");
      log_.write(piece.data(), static_cast<std::streamsize>(piece.size()));
      if (received_ == bytes_) log_.close();
      if (!log_) throw std::runtime_error("the file cannot be written to " + fs::temp_directory_path().string());
      link_.send_text(fmt::format(R"({{"received":{}}})", received_));
      if (received_ == bytes_) start();
    });
  }
  void on_drained() override {
    // The answer may be large, and is sent when nothing waits before it.
    if (!answer_ || link_.queued_bytes() > 0) return;
    link_.send(*std::exchange(answer_, std::nullopt));
    link_.close("done");
  }

 private:
  template <typename Work>
  void attempt(Work work) {
    if (is_over_) return;
    try {
      work();
    } catch (const std::exception& error) {
      end_with(refusal(error.what()), false);
    }
  }
  void end_with(std::string bytes, bool is_page) {
    is_over_ = true;
    drop();
    answer_ = Payload{std::make_shared<const std::string>(std::move(bytes)), is_page};
    on_drained();
  }
  void start() {
    constexpr int kBaud = 115200, kNice = 10;
    // The program shows its progress on a terminal only.
    terminal_ = ports::make_pseudo_terminal(kBaud);
    words_.assign(::dup(terminal_.master.get()));
    const fs::path beside = fs::read_symlink("/proc/self/exe").replace_filename("navcal");
    pid_ = base::spawn({.command = {fs::exists(beside) ? beside.string() : "navcal", "audit", "--report", page(),
                                    "./" + file_.filename().string()},
                        .errors = terminal_.slave_name,
                        .folder = file_.parent_path(),
                        .variable = "TMPDIR=" + folder_->path().string()});  // its temporary files go with ours
    (void)::setpriority(PRIO_PROCESS, static_cast<id_t>(pid_), kNice);
    follow();
  }
  void follow() {
    const auto heard = [this, turn = std::weak_ptr(turn_)](const boost::system::error_code& ended, std::size_t n) {
      if (turn.expired()) return;  // this object has gone
      if (ended) return finish();
      for (const char c : std::string_view(chunk_.data(), n)) hear(c);
      follow();
    };
    words_.async_read_some(asio::buffer(chunk_), heard);
  }
  void hear(char c) {
    const bool is_letter = static_cast<unsigned char>(c) >= 0x20;
    if (is_letter) line_ += c;
    if (line_ == "[K") line_.clear();  // of an escape sequence, which clears the line
    if (is_letter || line_.empty()) return;
    said_ = std::exchange(line_, {});
    link_.send_text(record::json_text({{"progress", said_}}));
  }
  void finish() {
    using Bytes = std::istreambuf_iterator<char>;
    std::ifstream made(page(), std::ios::binary);
    if (reap() == 0 && made) return end_with(std::string(Bytes(made), Bytes()), true);
    end_with(refusal(said_.empty() ? "navcal audit ended without an answer" : said_), false);
  }
  /// Ends the audit and removes its files.
  void drop() {
    if (pid_ > 0) ::kill(-pid_, SIGKILL);
    (void)reap();
    turn_.reset();
    folder_.reset();
  }
  int reap() {
    const pid_t child = std::exchange(pid_, 0);
    return child > 0 ? base::wait_for(child) : 0;
  }
  [[nodiscard]] std::string page() const { return folder_->path() / "page.html"; }

  PeerLink& link_;
  std::weak_ptr<const char>& last_turn_;
  AuditTurn turn_;
  std::optional<base::TemporaryFolder> folder_;
  fs::path file_;
  std::ofstream log_;
  std::uint64_t bytes_ = 0, received_ = 0;
  ports::PseudoTerminal terminal_{};
  asio::posix::stream_descriptor words_;
  std::array<char, 4096> chunk_{};
  std::string line_, said_;
  std::optional<Payload> answer_;
  pid_t pid_ = 0;
  bool is_over_ = false;
};

}  // namespace

WebSocketEndpoint audit_endpoint(const asio::any_io_executor& executor) {
  return {.path = "/audit",
          .make_peer = [executor, last_turn = std::make_shared<std::weak_ptr<const char>>()](
                           PeerLink& link, std::string_view) -> std::unique_ptr<Peer> {
            return std::make_unique<AuditPeer>(executor, link, *last_turn);
          }};
}

}  // namespace navcal::web
