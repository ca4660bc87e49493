// SPDX-License-Identifier: Apache-2.0
#include "emulate_program.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <stdexcept>

#include "ports/raw_mode.h"
#include "tests/support/process.h"

namespace navcal::cli::test {
namespace {

std::array<base::Descriptor, 2> make_pipe() {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
  return {base::Descriptor(ends[0]), base::Descriptor(ends[1])};
}

}  // namespace

Program::Program(std::vector<std::string> arguments) {
  auto in = make_pipe();
  auto out = make_pipe();
  auto err = make_pipe();
  arguments.insert(arguments.begin(), NAVCAL_PROGRAM);
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  pid_ = ::fork();
  if (pid_ == 0) {
    navcal::test::die_with_parent();
    ::dup2(in[0].get(), STDIN_FILENO);
    ::dup2(out[1].get(), STDOUT_FILENO);
    ::dup2(err[1].get(), STDERR_FILENO);
    ::execv(argv[0], argv.data());
    ::_exit(127);
  }
  input_ = std::move(in[1]);
  output_ = std::move(out[0]);
  errors_ = std::move(err[0]);
}

Program::~Program() {
  if (pid_ <= 0) return;
  ::kill(pid_, SIGKILL);
  ::waitpid(pid_, nullptr, 0);
}

std::string Program::line() {
  std::string text;
  for (char byte = 0; ::read(output_.get(), &byte, 1) == 1 && byte != '\n';) text += byte;
  return text;
}

void Program::type(std::string_view text) {
  if (::write(input_.get(), text.data(), text.size()) < 0) throw std::runtime_error("the program does not listen");
}

void Program::interrupt() { ::kill(pid_, SIGINT); }

int Program::wait() {
  int status = 0;
  ::waitpid(pid_, &status, 0);
  pid_ = -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

std::string Program::errors() {
  std::string text;
  std::array<char, 1024> buffer{};
  for (ssize_t n = 0; (n = ::read(errors_.get(), buffer.data(), buffer.size())) > 0;) {
    text.append(buffer.data(), static_cast<std::size_t>(n));
  }
  return text;
}

Client::Client(const std::filesystem::path& port)
    : fd_(::open(port.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC)) {
  if (!fd_) throw std::runtime_error("cannot open " + port.string());
}

void Client::set_speed(int baud) const {
  if (!ports::set_raw(fd_.get(), baud)) throw std::runtime_error("cannot set the speed");
}

void Client::write(std::string_view text) const {
  if (::write(fd_.get(), text.data(), text.size()) < 0) throw std::runtime_error("cannot write");
}

bool Client::read_some() {
  pollfd state{fd_.get(), POLLIN, 0};
  if (::poll(&state, 1, 20) <= 0) return true;
  std::array<char, 4096> buffer{};
  const ssize_t n = ::read(fd_.get(), buffer.data(), buffer.size());
  if (n > 0) read_.append(buffer.data(), static_cast<std::size_t>(n));
  hung_up_ = n == 0;
  return !hung_up_;
}

const std::string& Client::read_until(std::string_view wanted, std::chrono::milliseconds limit) {
  const auto end = std::chrono::steady_clock::now() + limit;
  while (read_.find(wanted) == std::string::npos && std::chrono::steady_clock::now() < end && read_some()) {
  }
  return read_;
}

const std::string& Client::read_all() {
  while (read_some()) {
  }
  return read_;
}

}  // namespace navcal::cli::test
