// SPDX-License-Identifier: Apache-2.0
#include "ports/sample_socket.h"

#include <fmt/format.h>
#include <sys/epoll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "base/descriptor.h"
#include "protocols/samples_line.h"

namespace navcal::ports {
namespace {

constexpr std::size_t kSenderRead_bytes = 16'384;

std::optional<sockaddr_un> unix_address(const std::string& path) {
  sockaddr_un address{};
  if (path.size() >= sizeof address.sun_path) return std::nullopt;
  address.sun_family = AF_UNIX;
  std::memcpy(address.sun_path, path.data(), path.size());
  return address;
}

const sockaddr* generic(const sockaddr_un& address) { return reinterpret_cast<const sockaddr*>(&address); }

/// Whether a socket is there that no program listens to: a daemon that was killed leaves one behind.
bool is_left_behind(const std::string& path, const sockaddr_un& address) {
  struct stat found {};
  if (::lstat(path.c_str(), &found) != 0 || !S_ISSOCK(found.st_mode)) return false;
  const base::Descriptor probe(::socket(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  return probe && ::connect(probe.get(), generic(address), sizeof address) != 0 && errno == ECONNREFUSED;
}

class SampleSocket final : public Line {
 public:
  SampleSocket(base::Descriptor waiting, base::Descriptor listening, const std::string& path)
      : waiting_(std::move(waiting)), listening_(std::move(listening)), path_(path) {
    info_.path = "unix-listen:" + path;
    info_.is_network = true;
    info_.low_latency = "not applicable on a socket";
  }
  ~SampleSocket() override { ::unlink(path_.c_str()); }
  SampleSocket(const SampleSocket&) = delete;
  SampleSocket& operator=(const SampleSocket&) = delete;

  [[nodiscard]] int fd() const override { return waiting_.get(); }
  [[nodiscard]] const OpenPort& info() const override { return info_; }
  [[nodiscard]] ssize_t read(std::span<std::uint8_t> buffer) override;
  [[nodiscard]] ssize_t write(protocols::Bytes) override {
    errno = ENOTCONN;
    return -1;
  }
  [[nodiscard]] std::string ended() const override { return {}; }
  void flush(std::chrono::milliseconds /*limit*/) const override {}

 private:
  struct Sender {
    base::Descriptor socket;
    std::vector<std::uint8_t> tail{};  ///< of a line that is not whole yet
  };

  void accept_sender();
  void read_sender(int socket);
  void remove_sender(std::map<int, Sender>::iterator sender);
  void hand_over(std::vector<std::uint8_t>& bytes, std::size_t count);
  bool watch(int operation, int socket) const;

  base::Descriptor waiting_;  ///< epoll: readable when anything is to be done here
  base::Descriptor listening_;
  std::string path_;
  OpenPort info_;
  std::map<int, Sender> senders_;
  std::vector<std::uint8_t> ready_;  ///< whole lines
  std::size_t taken_ = 0;            ///< bytes of ready_ that were read
};

bool SampleSocket::watch(int operation, int socket) const {
  epoll_event event{};
  event.events = EPOLLIN;
  event.data.fd = socket;
  return ::epoll_ctl(waiting_.get(), operation, socket, &event) == 0;
}

ssize_t SampleSocket::read(std::span<std::uint8_t> buffer) {
  if (taken_ == ready_.size()) {
    ready_.clear();
    taken_ = 0;
    std::array<epoll_event, kMostSenders + 1> events{};
    const int count = ::epoll_wait(waiting_.get(), events.data(), static_cast<int>(events.size()), 0);
    if (count < 0) return -1;
    for (int i = 0; i < count; ++i) {
      const int socket = events[static_cast<std::size_t>(i)].data.fd;
      if (socket == listening_.get()) {
        accept_sender();
      } else {
        read_sender(socket);
      }
    }
  }
  if (taken_ == ready_.size()) {
    errno = EAGAIN;
    return -1;
  }
  const std::size_t n = std::min(buffer.size(), ready_.size() - taken_);
  std::memcpy(buffer.data(), ready_.data() + taken_, n);
  taken_ += n;
  return static_cast<ssize_t>(n);
}

void SampleSocket::accept_sender() {
  base::Descriptor socket(::accept4(listening_.get(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
  if (!socket) return;
  const int number = socket.get();
  if (!watch(EPOLL_CTL_ADD, number)) return;
  senders_.emplace(number, Sender{std::move(socket)});
  if (senders_.size() == kMostSenders) ::epoll_ctl(waiting_.get(), EPOLL_CTL_DEL, listening_.get(), nullptr);
}

void SampleSocket::read_sender(int socket) {
  const auto sender = senders_.find(socket);
  if (sender == senders_.end()) return;
  auto& tail = sender->second.tail;
  const std::size_t before = tail.size();
  tail.resize(before + kSenderRead_bytes);
  const ssize_t n = ::recv(socket, tail.data() + before, kSenderRead_bytes, 0);
  tail.resize(before + static_cast<std::size_t>(std::max<ssize_t>(n, 0)));
  if (n == 0 || (n < 0 && errno != EAGAIN && errno != EINTR)) return remove_sender(sender);
  const auto newest_end = std::find(tail.rbegin(), tail.rend(), '\n');
  hand_over(tail, static_cast<std::size_t>(tail.rend() - newest_end));
  if (tail.size() >= protocols::samples_line::kMaxLength) hand_over(tail, tail.size());
}

void SampleSocket::remove_sender(std::map<int, Sender>::iterator sender) {
  hand_over(sender->second.tail, sender->second.tail.size());
  if (senders_.size() == kMostSenders) watch(EPOLL_CTL_ADD, listening_.get());
  senders_.erase(sender);  // closing a socket takes it out of the epoll set
}

void SampleSocket::hand_over(std::vector<std::uint8_t>& bytes, std::size_t count) {
  const auto end = bytes.begin() + static_cast<std::ptrdiff_t>(count);
  ready_.insert(ready_.end(), bytes.begin(), end);
  bytes.erase(bytes.begin(), end);
}

}  // namespace

std::variant<std::unique_ptr<Line>, std::string> open_sample_socket(const std::string& path) {
  const auto refusal = [&](int error) { return fmt::format("unix-listen:{}: {}", path, std::strerror(error)); };
  const auto address = unix_address(path);
  if (!address) return refusal(ENAMETOOLONG);
  base::Descriptor socket(::socket(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  base::Descriptor waiting(::epoll_create1(EPOLL_CLOEXEC));
  if (!socket || !waiting) return refusal(errno);
  if (is_left_behind(path, *address)) ::unlink(path.c_str());
  if (::bind(socket.get(), generic(*address), sizeof *address) != 0) return refusal(errno);
  // Nobody can connect before listen(): the mode is in force for everybody.
  constexpr int kBacklog = 16;
  epoll_event event{};
  event.events = EPOLLIN;
  event.data.fd = socket.get();
  if (::chmod(path.c_str(), 0660) != 0 || ::listen(socket.get(), kBacklog) != 0 ||
      ::epoll_ctl(waiting.get(), EPOLL_CTL_ADD, socket.get(), &event) != 0) {
    const int error = errno;
    ::unlink(path.c_str());
    return refusal(error);
  }
  return std::make_unique<SampleSocket>(std::move(waiting), std::move(socket), path);
}

}  // namespace navcal::ports
